#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "gltf_tessellation.h"
#include "gltf_texture.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"
#include "quadrille/export.h"

namespace quadrille {
namespace {

/// Appends the elements to the only buffer, aligned to 4 bytes; returns the new view's index.
template <class T>
int add_view(tinygltf::Model& model, const std::vector<T>& elements, int target) {
  std::vector<unsigned char>& buffer = model.buffers.front().data;
  buffer.resize((buffer.size() + 3) / 4 * 4);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = buffer.size();
  view.byteLength = elements.size() * sizeof(T);
  view.target = target;
  buffer.resize(buffer.size() + view.byteLength);
  std::memcpy(buffer.data() + view.byteOffset, elements.data(), view.byteLength);
  model.bufferViews.push_back(view);
  return static_cast<int>(model.bufferViews.size()) - 1;
}

template <std::size_t N>
int add_vertices(tinygltf::Model& model, const std::vector<std::array<float, N>>& values) {
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(model, values, TINYGLTF_TARGET_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.count = values.size();
  accessor.type = N == 2 ? TINYGLTF_TYPE_VEC2 : TINYGLTF_TYPE_VEC3;
  accessor.minValues.assign(N, std::numeric_limits<double>::infinity());
  accessor.maxValues.assign(N, -std::numeric_limits<double>::infinity());
  for (const auto& value : values) {
    for (std::size_t c = 0; c < N; ++c) {
      accessor.minValues[c] = std::min<double>(accessor.minValues[c], value[c]);
      accessor.maxValues[c] = std::max<double>(accessor.maxValues[c], value[c]);
    }
  }
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

int add_indices(tinygltf::Model& model, const TriangleMesh& triangles) {
  tinygltf::Accessor accessor;
  // 65535 is the value that restarts a strip, so the largest 16-bit index is 65534.
  if (triangles.positions.size() <= 65535) {
    const std::vector<std::uint16_t> narrow(triangles.indices.begin(), triangles.indices.end());
    accessor.bufferView = add_view(model, narrow, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  } else {
    accessor.bufferView = add_view(model, triangles.indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  }
  accessor.count = triangles.indices.size();
  accessor.type = TINYGLTF_TYPE_SCALAR;
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

int add_material(tinygltf::Model& model, const Texture& texture) {
  tinygltf::Image picture;
  picture.mimeType = "image/png";
  picture.bufferView = add_view(model, encode_png(texture), 0);
  model.images.push_back(std::move(picture));

  tinygltf::Texture reference;
  reference.source = static_cast<int>(model.images.size()) - 1;
  reference.sampler = 0;
  model.textures.push_back(std::move(reference));

  tinygltf::Material material;
  material.pbrMetallicRoughness.baseColorTexture.index =
      static_cast<int>(model.textures.size()) - 1;
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.alphaMode = texture.channels == 4 ? "BLEND" : "OPAQUE";
  material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

/// A mesh and its node. Layers are stacked one unit apart, because surfaces of equal depth would
/// flicker.
void add_layer(tinygltf::Model& model, const VectorImage& image, const Layer& layer, int depth,
               const GltfOptions& options, const RunContext& context) {
  const TriangleMesh triangles = tessellate(layer, image.height);
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 2>> texture_coordinates;
  positions.reserve(triangles.positions.size());
  texture_coordinates.reserve(triangles.positions.size());
  for (const auto& p : triangles.positions) {
    positions.push_back({p[0], p[1], 0.0f});
    texture_coordinates.push_back({static_cast<float>(p[0] / image.width),
                                   static_cast<float>((image.height - p[1]) / image.height)});
  }

  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = add_vertices(model, positions);
  primitive.attributes["TEXCOORD_0"] = add_vertices(model, texture_coordinates);
  primitive.indices = add_indices(model, triangles);
  primitive.material =
      add_material(model, layer_texture(image, layer, options.texels_per_pixel, context));

  tinygltf::Mesh mesh;
  mesh.name = layer.name;
  mesh.primitives.push_back(std::move(primitive));
  model.meshes.push_back(std::move(mesh));

  tinygltf::Node node;
  node.name = layer.name;
  node.mesh = static_cast<int>(model.meshes.size()) - 1;
  if (depth > 0) node.translation = {0, 0, double(depth)};
  model.nodes.push_back(std::move(node));
  model.scenes.front().nodes.push_back(static_cast<int>(model.nodes.size()) - 1);
}

tinygltf::Model empty_model(const VectorImage& image) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "Quadrille";
  model.asset.extras = tinygltf::Value(tinygltf::Value::Object{
      {"unit", tinygltf::Value(std::string("pixel"))},
      {"width", tinygltf::Value(image.width)},
      {"height", tinygltf::Value(image.height)},
  });
  model.extensionsUsed = {"KHR_materials_unlit"};
  model.buffers.emplace_back();
  model.scenes.emplace_back();
  model.defaultScene = 0;
  tinygltf::Sampler sampler;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
  sampler.wrapS = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  model.samplers.push_back(sampler);
  return model;
}

}  // namespace

void write_glb(const VectorImage& image, const std::filesystem::path& path,
               const GltfOptions& options, const RunContext& context) {
  if (!(options.texels_per_pixel > 0) || !std::isfinite(options.texels_per_pixel)) {
    throw Error(ErrorCode::invalid_argument, "texels per pixel must be positive, not " +
                                                 std::to_string(options.texels_per_pixel) +
                                                 "; 2 suits most pictures");
  }
  if (image.patch_count() == 0) {
    throw Error(ErrorCode::invalid_argument,
                "the picture has no patches, which glTF cannot hold; add a layer with patches");
  }
  tinygltf::Model model = empty_model(image);
  int depth = 0;
  for (const Layer& layer : image.layers) {
    if (layer.patches.patch_count() == 0) continue;
    add_layer(model, image, layer, depth++, options, context);
  }
  write_stream_atomically(path, [&](std::ostream& file) {
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, file, false, true)) {
      file.setstate(std::ios::failbit);
    }
  });
}

}  // namespace quadrille
