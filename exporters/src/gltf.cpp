#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "gltf_buffers.h"
#include "gltf_control.h"
#include "gltf_file.h"
#include "gltf_sharpen.h"
#include "gltf_surface.h"
#include "patch_opacity.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "sheet_texture.h"
#include "sheeted_layer.h"
#include "texture_file.h"

namespace quadrille {
namespace {

using tinygltf::Value;

void check(const VectorImage& image, const GltfOptions& options) {
  const auto reject = [](const std::string& message) {
    throw Error(ErrorCode::invalid_argument, message);
  };
  if (!(options.texels_per_pixel > 0) || !std::isfinite(options.texels_per_pixel)) {
    reject("texels per pixel must be positive, not " + std::to_string(options.texels_per_pixel) +
           "; 2 suits most pictures");
  }
  if (options.texture_quality < 1 || options.texture_quality > 100) {
    reject("a texture quality of " + std::to_string(options.texture_quality) +
           " is out of range; use 1 to 100");
  }
  if (!(std::abs(options.relief) <= 1e6)) {
    reject("a relief of " + std::to_string(options.relief) +
           " pixels is out of range; use -1000000 to 1000000");
  }
  if (image.patch_count() == 0) {
    reject("the picture has no patches, which glTF cannot hold; add a layer with patches");
  }
}

/// Part of a larger progress.
RunContext share(const RunContext& context, double from, double to) {
  RunContext part;
  part.threads = context.threads;
  part.on_progress = [&context, from, to](const std::string&, double fraction) {
    context.progress("glTF", from + (to - from) * fraction);
    return true;
  };
  return part;
}

/// A file in the making.
class GltfWriter {
 public:
  GltfWriter(const VectorImage& image, const GltfOptions& options)
      : image_(image), options_(options), buffers_(model_, options.compression) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Quadrille";
    model_.asset.extras = Value(Value::Object{{"unit", Value(std::string("pixel"))},
                                              {"width", Value(image.width)},
                                              {"height", Value(image.height)}});
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    use("FB_ngon_encoding", false);
    if (!options.lit) use("KHR_materials_unlit", false);
    if (options.compression != GltfCompression::none) use("KHR_mesh_quantization", true);
    if (options.compression == GltfCompression::meshopt) use("EXT_meshopt_compression", true);
    if (options.colors == GltfColors::vertex) return;
    if (options.texture_format == GltfTextureFormat::webp) use("EXT_texture_webp", true);
    tinygltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.wrapS = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model_.samplers.push_back(sampler);
  }

  /// A mesh and its node, if anything of the layer can be seen. Layers are stacked a unit and the
  /// relief apart, because surfaces of equal depth would flicker.
  void add_layer(const Layer& given, const RunContext& context) {
    const SheetedLayer layer(given);
    if (layer.is_empty()) return;
    const SurfaceContent content{options_.colors == GltfColors::vertex, options_.lit,
                                 options_.relief};
    const std::vector<SurfacePart> parts =
        make_surface(layer, image_.height, content, share(context, 0, 0.3));
    const PositionGrid grid = position_grid(parts);
    tinygltf::Mesh mesh;
    mesh.name = given.name;
    mesh.extras =
        Value(Value::Object{{"quadrille_document", Value(control_document(image_, given))}});
    if (content.has_colors) {
      mesh.primitives.push_back(colored_primitive(given, joined(parts), grid));
    } else {
      for (int sheet = 0; sheet < layer.sheet_count(); ++sheet) {
        const RunContext part = share(context, 0.3 + 0.7 * sheet / layer.sheet_count(),
                                      0.3 + 0.7 * (sheet + 1) / layer.sheet_count());
        mesh.primitives.push_back(textured_primitive(layer, sheet, parts[sheet], grid, part));
      }
    }
    model_.meshes.push_back(std::move(mesh));
    add_node(given.name, grid);
  }

  void write(const std::filesystem::path& path) {
    write_gltf_files(model_, buffers_, textures_, path);
  }

 private:
  void use(const std::string& extension, bool is_required) {
    model_.extensionsUsed.push_back(extension);
    if (is_required) model_.extensionsRequired.push_back(extension);
  }

  /// Vertex colours need no sheets.
  static SurfacePart joined(const std::vector<SurfacePart>& parts) {
    SurfacePart whole;
    for (const SurfacePart& part : parts) {
      const auto first = static_cast<std::uint32_t>(whole.positions.size());
      const auto append = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
      };
      append(whole.positions, part.positions);
      append(whole.normals, part.normals);
      append(whole.colors, part.colors);
      for (const std::uint32_t index : part.indices) whole.indices.push_back(first + index);
    }
    return whole;
  }

  tinygltf::Primitive bare_primitive(const SurfacePart& part, const PositionGrid& grid) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.extensions["FB_ngon_encoding"] = Value(Value::Object());
    primitive.attributes["POSITION"] = buffers_.add_positions(part.positions, grid);
    if (!part.normals.empty()) primitive.attributes["NORMAL"] = buffers_.add_normals(part.normals);
    primitive.indices = buffers_.add_indices(part.indices, part.positions.size());
    return primitive;
  }

  tinygltf::Primitive colored_primitive(const Layer& layer, const SurfacePart& part,
                                        const PositionGrid& grid) {
    tinygltf::Primitive primitive = bare_primitive(part, grid);
    primitive.attributes["COLOR_0"] = buffers_.add_colors(part.colors);
    constexpr double kNearlyOpaque = 1.0 / 255;
    const auto translucent =
        patches_with(patch_opacities(layer.patches, kNearlyOpaque), PatchOpacity::translucent);
    primitive.material = add_material(translucent.empty() ? AlphaMode::opaque : AlphaMode::blend);
    return primitive;
  }

  tinygltf::Primitive textured_primitive(const SheetedLayer& layer, int sheet,
                                         const SurfacePart& part, const PositionGrid& grid,
                                         const RunContext& context) {
    SheetTexture drawn =
        sheet_texture(image_, layer, sheet, options_.texels_per_pixel, share(context, 0, 0.4));
    sharpen_for_filtering(drawn.texture);
    textures_.push_back(encode(drawn.texture, options_.texture_format, options_.texture_quality,
                               share(context, 0.4, 1)));
    tinygltf::Primitive primitive = bare_primitive(part, grid);
    const double scale_x = drawn.picture_width / image_.width,
                 scale_y = drawn.picture_height / image_.height;
    std::vector<std::array<float, 2>> coordinates;
    coordinates.reserve(part.positions.size());
    for (const auto& p : part.positions) {
      const double x = p[0] * scale_x - drawn.region.x;
      const double y = (image_.height - p[1]) * scale_y - drawn.region.y;
      coordinates.push_back({static_cast<float>(x / drawn.region.width),
                             static_cast<float>(y / drawn.region.height)});
    }
    primitive.attributes["TEXCOORD_0"] = buffers_.add_texture_coordinates(coordinates);
    primitive.material = add_material(drawn.alpha_mode, add_texture());
    return primitive;
  }

  /// For the picture that was encoded last.
  int add_texture() {
    tinygltf::Texture texture;
    const int source = static_cast<int>(textures_.size()) - 1;
    if (options_.texture_format == GltfTextureFormat::webp) {
      texture.extensions["EXT_texture_webp"] = Value(Value::Object{{"source", Value(source)}});
    } else {
      texture.source = source;
    }
    texture.sampler = 0;
    model_.textures.push_back(std::move(texture));
    return static_cast<int>(model_.textures.size()) - 1;
  }

  int add_material(AlphaMode alpha_mode, int texture = -1) {
    tinygltf::Material material;
    material.pbrMetallicRoughness.baseColorTexture.index = texture;
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 1;
    constexpr const char* kModes[] = {"OPAQUE", "MASK", "BLEND"};
    material.alphaMode = kModes[static_cast<int>(alpha_mode)];
    material.doubleSided = true;
    if (!options_.lit) material.extensions["KHR_materials_unlit"] = Value(Value::Object());
    model_.materials.push_back(std::move(material));
    return static_cast<int>(model_.materials.size()) - 1;
  }

  void add_node(const std::string& name, const PositionGrid& grid) {
    tinygltf::Node node;
    node.name = name;
    node.mesh = static_cast<int>(model_.meshes.size()) - 1;
    std::array<double, 3> at = {0, 0, 0};
    if (options_.compression != GltfCompression::none) {
      node.scale.assign(3, grid.scale);
      at = grid.offset;
    }
    at[2] += node.mesh * (1 + std::abs(options_.relief));
    if (at != std::array<double, 3>{}) node.translation.assign(at.begin(), at.end());
    model_.nodes.push_back(std::move(node));
    model_.scenes.front().nodes.push_back(static_cast<int>(model_.nodes.size()) - 1);
  }

  const VectorImage& image_;
  const GltfOptions& options_;
  tinygltf::Model model_;
  GltfBuffers buffers_;
  std::vector<EncodedTexture> textures_;
};

}  // namespace

void write_gltf(const VectorImage& image, const std::filesystem::path& path,
                const GltfOptions& options, const RunContext& context) {
  check(image, options);
  GltfWriter writer(image, options);
  const double count = static_cast<double>(image.layers.size());
  for (std::size_t k = 0; k < image.layers.size(); ++k) {
    writer.add_layer(image.layers[k], share(context, k / count, (k + 1) / count));
  }
  context.progress("glTF", 1);
  writer.write(path);
}

}  // namespace quadrille
