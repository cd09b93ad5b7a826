#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace quadrille::test {

/// A binary glTF file taken apart by the letter of the specification (section 4.4).
class GlbFile {
 public:
  explicit GlbFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    bytes = {std::istreambuf_iterator<char>(file), {}};
    if (bytes.substr(0, 4) != "glTF" || word(4) != 2 || word(8) != bytes.size()) {
      throw std::runtime_error("bad GLB header");
    }
    const std::size_t json_size = word(12);
    if (word(16) != 0x4E4F534A) throw std::runtime_error("no JSON chunk");
    gltf = nlohmann::json::parse(bytes.substr(20, json_size));
    const std::size_t binary_at = 20 + json_size;
    if (word(binary_at + 4) != 0x004E4942) throw std::runtime_error("no binary chunk");
    binary = bytes.substr(binary_at + 8, word(binary_at));
  }

  std::string view(int index) const {
    const auto& v = gltf["bufferViews"][index];
    return binary.substr(v.value("byteOffset", 0), v["byteLength"]);
  }

  std::vector<std::vector<float>> vertices(int accessor) const {
    const auto& a = gltf["accessors"][accessor];
    const int components = a["type"] == "VEC3" ? 3 : 2;
    const std::string data = view(a["bufferView"]);
    std::vector<std::vector<float>> result(a["count"], std::vector<float>(components));
    for (std::size_t i = 0; i < result.size(); ++i) {
      std::memcpy(result[i].data(), data.data() + 4 * components * i, 4 * components);
    }
    return result;
  }

  std::vector<std::uint32_t> indices(int accessor) const {
    const auto& a = gltf["accessors"][accessor];
    const std::string data = view(a["bufferView"]);
    const std::size_t size = a["componentType"] == 5123 ? 2 : 4;
    std::vector<std::uint32_t> result(a["count"], 0);
    for (std::size_t i = 0; i < result.size(); ++i) {
      std::memcpy(&result[i], data.data() + size * i, size);
    }
    return result;
  }

  const nlohmann::json& primitive(int mesh) const { return gltf["meshes"][mesh]["primitives"][0]; }

  std::string bytes, binary;
  nlohmann::json gltf;

 private:
  std::uint32_t word(std::size_t at) const {
    std::uint32_t value = 0;
    if (at + 4 > bytes.size()) throw std::runtime_error("truncated GLB");
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  }
};

}  // namespace quadrille::test
