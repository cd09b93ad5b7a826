#include "exporters/gltf_file.h"

#include <meshoptimizer.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>

#include "quadrille/image_file.h"
#include "quadrille/patch_geometry.h"
#include "support/programs.h"
#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille::test {
namespace {

using nlohmann::json;

std::string all_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class T>
double number(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<double>(value);
}

double component(const char* at, int type) {
  switch (type) {
    case 5122:
      return number<std::int16_t>(at);
    case 5123:
      return number<std::uint16_t>(at);
    case 5125:
      return number<std::uint32_t>(at);
    default:
      return number<float>(at);
  }
}

double largest(const json& accessor) {
  if (!accessor.value("normalized", false)) return 1;
  return accessor["componentType"] == 5122 ? 32767 : 65535;
}

}  // namespace

GltfFile::GltfFile(const std::filesystem::path& file) : path(file), bytes(all_bytes(file)) {
  if (path.extension() == ".gltf") {
    gltf = json::parse(bytes);
    binary_ = all_bytes(path.parent_path() / std::string(gltf["buffers"][0]["uri"]));
    return;
  }
  if (bytes.substr(0, 4) != "glTF" || word(4) != 2 || word(8) != bytes.size()) {
    throw std::runtime_error("bad GLB header");
  }
  const std::size_t json_size = word(12);
  if (word(16) != 0x4E4F534A) throw std::runtime_error("no JSON chunk");
  gltf = json::parse(bytes.substr(20, json_size));
  const std::size_t binary_at = 20 + json_size;
  if (word(binary_at + 4) != 0x004E4942) throw std::runtime_error("no binary chunk");
  binary_ = bytes.substr(binary_at + 8, word(binary_at));
}

std::uint32_t GltfFile::word(std::size_t at) const {
  std::uint32_t value = 0;
  if (at + 4 > bytes.size()) throw std::runtime_error("truncated GLB");
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

std::string GltfFile::view(int index) const {
  const json& v = gltf["bufferViews"][index];
  if (v["buffer"] != 0) return unpacked(v["extensions"]["EXT_meshopt_compression"]);
  return binary_.substr(v.value("byteOffset", 0), v["byteLength"]);
}

std::string GltfFile::unpacked(const json& packed) const {
  const auto* from = reinterpret_cast<const unsigned char*>(binary_.data()) +
                     packed["byteOffset"].get<std::size_t>();
  const std::size_t size = packed["byteLength"], count = packed["count"],
                    stride = packed["byteStride"];
  std::string out(count * stride, '\0');
  const int status = packed["mode"] == "ATTRIBUTES"
                         ? meshopt_decodeVertexBuffer(out.data(), count, stride, from, size)
                         : meshopt_decodeIndexSequence(out.data(), count, stride, from, size);
  if (status != 0) throw std::runtime_error("meshoptimizer does not decode a buffer view");
  return out;
}

std::vector<std::vector<double>> GltfFile::values(int index) const {
  const json& accessor = gltf["accessors"][index];
  const json& v = gltf["bufferViews"][accessor["bufferView"].get<int>()];
  const std::string type = accessor["type"], data = view(accessor["bufferView"]);
  const std::size_t components = type == "SCALAR" ? 1 : type[3] - '0';
  const int component_type = accessor["componentType"];
  const std::size_t size = component_type == 5122 || component_type == 5123 ? 2 : 4;
  const std::size_t stride = v.value("byteStride", components * size);
  std::vector<std::vector<double>> result(accessor["count"], std::vector<double>(components));
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t c = 0; c < components; ++c) {
      result[i][c] =
          component(data.data() + i * stride + c * size, component_type) / largest(accessor);
    }
  }
  return result;
}

std::vector<std::uint32_t> GltfFile::indices(int accessor) const {
  std::vector<std::uint32_t> result;
  for (const auto& value : values(accessor)) {
    result.push_back(static_cast<std::uint32_t>(value[0]));
  }
  return result;
}

std::vector<std::vector<double>> GltfFile::attribute(int index, const std::string& name) const {
  auto result = values(primitive(0, index)["attributes"][name]);
  const json& node = gltf["nodes"][0];
  for (auto& value : result) {
    for (int c = 0; c < 3 && name == "POSITION"; ++c) {
      if (node.contains("scale")) value[c] *= node["scale"][c].get<double>();
      if (node.contains("translation")) value[c] += node["translation"][c].get<double>();
    }
  }
  return result;
}

std::vector<std::uint32_t> GltfFile::triangles(int index) const {
  return indices(primitive(0, index)["indices"]);
}

std::string GltfFile::image_bytes(int index) const {
  const json& image = gltf["images"][index];
  if (image.contains("uri")) return all_bytes(path.parent_path() / std::string(image["uri"]));
  return view(image["bufferView"]);
}

Raster GltfFile::image(int index) const {
  const std::string type = gltf["images"][index]["mimeType"];
  const auto file = scratch_dir() / ("texture." + type.substr(type.find('/') + 1));
  std::ofstream(file, std::ios::binary) << image_bytes(index);
  return load_image(file);
}

GltfFile written(const VectorImage& image, const GltfOptions& options, const RunContext& context,
                 const std::string& ending) {
  static int count = 0;
  const auto path = scratch_dir() / ("picture" + std::to_string(count++) + ending);
  write_gltf(image, path, options, context);
  return GltfFile(path);
}

VectorImage torn_disc(bool is_opaque) {
  testing::DiscMesh disc = testing::disc_mesh(3, 2, 2, 40, 32, {21, 15}, 9);
  testing::tear(disc.mesh, disc.circle);
  PatchMesh patches = straight_patches(std::move(disc.mesh));
  set_bessel_tangents(patches);
  testing::set_random_colors(patches, 7, is_opaque);
  return testing::single_layer(std::move(patches), 40, 32);
}

std::vector<std::vector<std::uint32_t>> polygons(const std::vector<std::uint32_t>& triangles) {
  std::vector<std::vector<std::uint32_t>> found;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    if (!found.empty() && found.back().front() == triangles[i]) {
      if (found.back().back() != triangles[i + 1]) throw std::runtime_error("a broken fan");
      found.back().push_back(triangles[i + 2]);
    } else {
      found.emplace_back(triangles.begin() + i, triangles.begin() + i + 3);
    }
  }
  return found;
}

std::vector<std::pair<Place, Place>> open_sides(const GltfFile& file, int* repeated) {
  std::set<std::pair<Place, Place>> sides;
  int again = 0;
  for (std::size_t p = 0; p < file.primitive_count(0); ++p) {
    const auto places = file.attribute(static_cast<int>(p), "POSITION");
    const auto triangles = file.triangles(static_cast<int>(p));
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      for (int k = 0; k < 3; ++k) {
        const Place &from = places[triangles[i + k]], &to = places[triangles[i + (k + 1) % 3]];
        again += !sides.emplace(from, to).second;
      }
    }
  }
  if (repeated) *repeated = again;
  std::vector<std::pair<Place, Place>> open;
  for (const auto& [from, to] : sides) {
    if (!sides.contains({to, from})) open.emplace_back(from, to);
  }
  return open;
}

}  // namespace quadrille::test
