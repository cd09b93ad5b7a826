#include "gltf_file.h"

#include <tiny_gltf.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <span>
#include <sstream>
#include <string>

#include "ending.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct SideFile {
  fs::path path;
  std::span<const unsigned char> bytes;
};

/// All characters but the unreserved ones of RFC 3986 as %XX.
std::string as_uri(const std::string& name) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string uri;
  for (const char c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_' || c == '~';
    const auto byte = static_cast<unsigned char>(c);
    if (is_plain) {
      uri += c;
    } else {
      uri += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return uri;
}

/// The model by tinygltf, and what that does not write: buffers without their bytes, pictures that
/// are not decoded, and the extension of compressed buffer views.
json document(tinygltf::Model& model, const GltfBuffers& buffers) {
  std::ostringstream text;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, text, false, false)) {
    throw Error(ErrorCode::io_failure, "tinygltf cannot describe the picture; try it again");
  }
  json result = json::parse(text.str());
  if (buffers.bytes().empty())
    return {{"asset", result["asset"]}, {"scene", 0}, {"scenes", {{{"name", "empty"}}}}};
  result["buffers"] = json::array({{{"byteLength", buffers.bytes().size()}}});
  if (buffers.decompressed_size() == 0) return result;
  result["buffers"].push_back(
      {{"byteLength", buffers.decompressed_size()},
       {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  for (const PackedView& packed : buffers.packed()) {
    result["bufferViews"][packed.view]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},
        {"byteOffset", packed.offset},
        {"byteLength", packed.size},
        {"byteStride", packed.stride},
        {"count", packed.count},
        {"mode", packed.is_vertices ? "ATTRIBUTES" : "INDICES"}};
  }
  return result;
}

void put_word(std::ostream& file, std::size_t value) {
  for (int k = 0; k < 4; ++k) file.put(static_cast<char>(value >> (8 * k)));
}

void put_bytes(std::ostream& file, std::span<const unsigned char> bytes) {
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

/// glTF 2.0, section 4.4.
void put_binary(std::ostream& file, std::string text, std::span<const unsigned char> bytes) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t padding = (4 - bytes.size() % 4) % 4,
                    chunk = bytes.empty() ? 0 : 8 + bytes.size() + padding,
                    whole = 12 + 8 + text.size() + chunk;
  constexpr std::size_t kMost = 0xFFFFFFFF;
  if (whole > kMost) {
    throw Error(ErrorCode::limit_exceeded,
                "a .glb file ends at 4 GiB; use fewer texels per pixel or write .gltf");
  }
  put_word(file, 0x46546C67);  // "glTF"
  put_word(file, 2);
  put_word(file, whole);
  put_word(file, text.size());
  put_word(file, 0x4E4F534A);  // "JSON"
  file << text;
  if (bytes.empty()) return;
  put_word(file, bytes.size() + padding);
  put_word(file, 0x004E4942);  // "BIN"
  put_bytes(file, bytes);
  for (std::size_t k = 0; k < padding; ++k) file.put('\0');
}

/// Files beside replace those of an older .gltf of the name, but nothing else.
void check_obstacles(std::span<const SideFile> files) {
  std::error_code error;
  const bool replaced = fs::exists(files.front().path, error);
  for (const SideFile& beside : files.subspan(1)) {
    const fs::file_status status = fs::status(beside.path, error);
    const bool is_file = fs::is_regular_file(status);
    if (status.type() == fs::file_type::not_found || (is_file && replaced)) continue;
    std::string reason = "cannot be made (" + error.message() + ");";
    if (fs::status_known(status)) reason = "is no file; move it or";
    if (is_file) reason = "is there already and belongs to no such file; move it or";
    throw Error(ErrorCode::io_failure,
                "cannot write '" + files.front().path.string() + "': '" + beside.path.string() +
                    "', which has to lie beside it, " + reason + " choose another name");
  }
}

/// Renames the last file first and the first one last. When a rename fails, those done before it
/// are taken back, unless they have replaced older ones.
void write_together(std::span<const SideFile> files) {
  if (files.empty()) return;
  std::vector<fs::path> renamed;
  try {
    write_stream_atomically(files.front().path, [&](std::ostream& stream) {
      put_bytes(stream, files.front().bytes);
      std::vector<fs::path> are_new;
      for (const SideFile& later : files.subspan(1)) {
        std::error_code ignored;
        if (!fs::exists(later.path, ignored)) are_new.push_back(later.path);
      }
      write_together(files.subspan(1));
      renamed = std::move(are_new);
    });
  } catch (...) {
    std::error_code ignored;
    for (const fs::path& path : renamed) fs::remove(path, ignored);
    throw;
  }
}

}  // namespace

void write_gltf_files(tinygltf::Model& model, GltfBuffers& buffers,
                      const std::vector<EncodedTexture>& textures, const fs::path& path) {
  json images = json::array();
  if (lower_case_ending(path) == ".glb") {
    for (const EncodedTexture& texture : textures) {
      images.push_back(
          {{"mimeType", texture.mime_type}, {"bufferView", buffers.add_file(texture.bytes)}});
    }
    json gltf = document(model, buffers);
    if (!images.empty()) gltf["images"] = images;
    write_stream_atomically(
        path, [&](std::ostream& file) { put_binary(file, gltf.dump(), buffers.bytes()); });
    return;
  }
  const auto beside = [&](const std::string& ending) {
    fs::path name = path.stem();
    name += ending;
    return name;
  };
  std::vector<SideFile> files = {{path, {}}};
  if (!buffers.bytes().empty()) {
    files.push_back({path.parent_path() / beside(".bin"), buffers.bytes()});
  }
  for (const EncodedTexture& texture : textures) {
    const fs::path name = beside("-texture-" + std::to_string(images.size()) + texture.ending);
    images.push_back({{"mimeType", texture.mime_type}, {"uri", as_uri(name.string())}});
    files.push_back({path.parent_path() / name, texture.bytes});
  }
  json gltf = document(model, buffers);
  if (gltf.contains("buffers")) gltf["buffers"][0]["uri"] = as_uri(beside(".bin").string());
  if (!images.empty()) gltf["images"] = images;
  const std::string text = gltf.dump();
  files.front().bytes = {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
  check_obstacles(files);
  write_together(files);
}

}  // namespace quadrille
