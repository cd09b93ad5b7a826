#include <fmt/core.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "common_options.h"
#include "output_files.h"
#include "picture_input.h"
#include "quadrille/document.h"

namespace quadrille::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct InfoRequest {
  fs::path input;
  bool json = false;
};

/// Counts of a layer, or of all of them.
struct Contents {
  long long patches = 0, vertices = 0, wedges = 0, tears = 0;
  double tear_length = 0;   ///< pixels of the picture, along the chords
  Eigen::AlignedBox2d box;  ///< of the vertices, in the picture

  void add(const Contents& other) {
    patches += other.patches;
    vertices += other.vertices;
    wedges += other.wedges;
    tears += other.tears;
    tear_length += other.tear_length;
    box.extend(other.box);
  }
};

Contents contents_of(const Layer& layer) {
  const QuadMesh& mesh = layer.patches.mesh;
  Contents c;
  c.patches = mesh.quad_count();
  c.vertices = mesh.vertex_count();
  c.wedges = std::ssize(layer.patches.wedges);
  for (const Eigen::Vector2d& v : mesh.vertices) c.box.extend(layer.transform * v);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!mesh.is_tear(e)) continue;
    const int h = mesh.halfedge(e);
    const Eigen::Vector2d chord = mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)];
    c.tear_length += (layer.transform.linear() * chord).norm();
    ++c.tears;
  }
  return c;
}

const char* name_of(DocumentEncoding encoding) {
  return encoding == DocumentEncoding::lossless ? "lossless" : "quantized";
}

Json box_of(const Contents& c) {
  if (c.box.isEmpty()) return nullptr;
  return {c.box.min().x(), c.box.min().y(), c.box.max().x(), c.box.max().y()};
}

Json json_of(const Contents& c) {
  return {{"patches", c.patches},
          {"vertices", c.vertices},
          {"wedges", c.wedges},
          {"tears", {{"edges", c.tears}, {"length", c.tear_length}}},
          {"bounding_box", box_of(c)}};
}

/// 0 for what is no file or cannot be reached.
std::uintmax_t bytes_of(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return 0;
  const std::uintmax_t bytes = fs::file_size(path, error);
  return error ? 0 : bytes;
}

/// With the pieces of a .vtm, which lie in a folder beside it.
std::uintmax_t stored_bytes(const fs::path& path) {
  std::uintmax_t bytes = bytes_of(path);
  if (ending_of(path) != ".vtm") return bytes;
  fs::path folder = path;
  folder.replace_extension() += "_vtm";
  std::error_code missing;  // another program may have named it otherwise
  for (fs::directory_iterator piece(folder, missing), end; piece != end; piece.increment(missing)) {
    bytes += bytes_of(piece->path());
  }
  return bytes;
}

/// The image of a file; what a file that is no .quad document does not tell of its storage is 0.
StoredImage read_stored(const fs::path& path) {
  if (ending_of(path) == ".quad") return load_document_and_storage(path);
  StoredImage stored{import_image(path), {}};
  stored.storage.file_bytes = stored_bytes(path);
  stored.storage.layers.resize(stored.image.layers.size());
  return stored;
}

bool is_quad(const DocumentStorage& storage) { return storage.version > 0; }

double bytes_per_patch(const DocumentStorage& storage, const Contents& all) {
  return all.patches > 0 ? static_cast<double>(storage.file_bytes) / all.patches : 0;
}

void print_json(const fs::path& path, const DocumentStorage& storage, const VectorImage& image,
                const std::vector<Contents>& layers, const Contents& all) {
  Json json = {{"file", printable_name(path)}, {"bytes", storage.file_bytes}};
  if (is_quad(storage)) json["version"] = storage.version;
  json.update({{"width", image.width}, {"height", image.height}, {"opaque", image.opaque()}});
  json.update(json_of(all));
  json["bytes_per_patch"] = bytes_per_patch(storage, all);
  json["layers"] = Json::array();
  for (std::size_t l = 0; l < layers.size(); ++l) {
    Json layer = {{"name", image.layers[l].name},
                  {"encoding", name_of(storage.layers[l].encoding)}};
    if (is_quad(storage)) layer["bytes"] = storage.layers[l].bytes;
    layer["opaque"] = image.layers[l].patches.opaque;
    if (storage.layers[l].encoding == DocumentEncoding::quantized) {
      layer["position_bits"] = storage.layers[l].position_bits;
      layer["color_step"] = storage.layers[l].color_step;
    }
    layer.update(json_of(layers[l]));
    json["layers"].push_back(std::move(layer));
  }
  json["metadata"] = Json::object();
  for (const auto& [key, value] : image.metadata) json["metadata"][key] = value;
  fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

/// Text from a document, which may hold anything, for one line of a terminal.
std::string printable(const std::string& text) {
  std::string line = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  line = line.substr(1, line.size() - 2);
  for (char& c : line) {
    if (c == 0x7f) c = '?';
  }
  return line;
}

void print_line(const char* name, const std::string& value) {
  fmt::print("{:<12} {}\n", name, value);
}

std::string described(const DocumentStorage::LayerStorage& layer) {
  if (layer.encoding == DocumentEncoding::lossless) return name_of(layer.encoding);
  return fmt::format("quantized, positions to {:g} pixels, colours to {:g} of 255",
                     std::ldexp(1.0, -layer.position_bits), layer.color_step);
}

std::string counted(long long count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string described(const Contents& c) {
  std::string text = counted(c.patches, "patch", "patches") + ", " +
                     counted(c.vertices, "vertex", "vertices") + ", " +
                     counted(c.wedges, "wedge", "wedges");
  if (c.tears > 0) {
    text += fmt::format(", {} of {:.1f} pixels together",
                        counted(c.tears, "tear edge", "tear edges"), c.tear_length);
  }
  return text;
}

void print_text(const fs::path& path, const DocumentStorage& storage, const VectorImage& image,
                const std::vector<Contents>& layers, const Contents& all) {
  print_line("file", fmt::format("{}, {} bytes", printable_name(path), storage.file_bytes) +
                         (is_quad(storage) ? fmt::format(", format version {}", storage.version)
                                           : std::string()));
  print_line("picture", fmt::format("{:g} x {:g} pixels, {}", image.width, image.height,
                                    image.opaque() ? "opaque" : "with transparency"));
  print_line("contents", described(all));
  if (all.patches > 0) {
    print_line("density", fmt::format("{:.2f} bytes per patch", bytes_per_patch(storage, all)));
  }
  for (std::size_t l = 0; l < layers.size(); ++l) {
    print_line("layer", fmt::format("{}: {}", printable(image.layers[l].name),
                                    described(storage.layers[l])));
    if (layers.size() > 1) print_line("", described(layers[l]));
    const Eigen::AlignedBox2d& box = layers[l].box;
    if (box.isEmpty()) continue;
    print_line("", fmt::format("from ({:g}, {:g}) to ({:g}, {:g})", box.min().x(), box.min().y(),
                               box.max().x(), box.max().y()));
  }
  for (const auto& [key, value] : image.metadata) {
    print_line("metadata", fmt::format("{}: {}", printable(key), printable(value)));
  }
}

int run_info(const InfoRequest& request) {
  const auto [image, storage] = read_stored(request.input);
  std::vector<Contents> layers;
  Contents all;
  for (const Layer& layer : image.layers) {
    layers.push_back(contents_of(layer));
    all.add(layers.back());
  }
  const auto print = request.json ? print_json : print_text;
  print(request.input, storage, image, layers, all);
  return kSuccess;
}

}  // namespace

Action declare_info(CLI::App& parser) {
  const auto request = std::make_shared<InfoRequest>();
  declare_input(parser, request->input, "file of patches: .quad, .vtu or .vtm");
  parser.add_flag("--json", request->json, "print one JSON object");
  return [request] { return run_info(*request); };
}

}  // namespace quadrille::cli
