#include "gltf_buffers.h"

#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace quadrille {
namespace {

constexpr double kMost = 65535;

std::uint16_t quantized(double value) {
  return static_cast<std::uint16_t>(std::clamp(value, 0.0, 1.0) * kMost + 0.5);
}

template <class T>
constexpr int component_type() {
  if (std::is_same_v<T, float>) return TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (std::is_same_v<T, std::int16_t>) return TINYGLTF_COMPONENT_TYPE_SHORT;
  return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
}

constexpr int kTypes[] = {0, TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                          TINYGLTF_TYPE_VEC4};

std::vector<unsigned char> compressed_vertices(const void* data, std::size_t count,
                                               std::size_t stride) {
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), data, count, stride));
  return bytes;
}

/// As a sequence: the encoder of triangles would rotate them, and their first vertices tell the
/// quads.
std::vector<unsigned char> compressed_indices(const void* data, std::size_t count,
                                              std::size_t stride) {
  std::vector<unsigned> indices(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(&indices[i], static_cast<const char*>(data) + i * stride, stride);
  }
  const std::size_t vertices = std::size_t{1} + *std::max_element(indices.begin(), indices.end());
  std::vector<unsigned char> bytes(meshopt_encodeIndexSequenceBound(count, vertices));
  meshopt_encodeIndexVersion(1);
  bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), count));
  return bytes;
}

}  // namespace

PositionGrid position_grid(const std::vector<SurfacePart>& parts) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low = {kInfinity, kInfinity, kInfinity};
  double longest = 0;
  for (int c = 0; c < 3; ++c) {
    double high = -kInfinity;
    for (const SurfacePart& part : parts) {
      for (const auto& p : part.positions) {
        low[c] = std::min<double>(low[c], p[c]);
        high = std::max<double>(high, p[c]);
      }
    }
    longest = std::max(longest, high - low[c]);
  }
  return {low, longest > 0 ? longest / kMost : 1};
}

std::size_t GltfBuffers::append(const void* data, std::size_t size) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  const std::size_t offset = bytes_.size();
  bytes_.resize(offset + size);
  std::memcpy(bytes_.data() + offset, data, size);
  return offset;
}

int GltfBuffers::add_view(const void* data, std::size_t count, std::size_t stride, int target) {
  tinygltf::BufferView view;
  view.target = target;
  view.byteLength = count * stride;
  const bool is_vertices = target == TINYGLTF_TARGET_ARRAY_BUFFER;
  if (is_vertices) view.byteStride = stride;
  if (compression_ != GltfCompression::meshopt) {
    view.buffer = 0;
    view.byteOffset = append(data, view.byteLength);
  } else {
    const auto packed = is_vertices ? compressed_vertices(data, count, stride)
                                    : compressed_indices(data, count, stride);
    packed_.push_back({static_cast<int>(model_.bufferViews.size()),
                       append(packed.data(), packed.size()), packed.size(), count, stride,
                       is_vertices});
    view.buffer = 1;
    view.byteOffset = decompressed_size_;
    decompressed_size_ += (view.byteLength + 3) / 4 * 4;
  }
  model_.bufferViews.push_back(std::move(view));
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

template <class T, std::size_t N>
int GltfBuffers::add_attribute(const std::vector<std::array<T, N>>& values, std::size_t components,
                               bool is_normalized, bool has_bounds) {
  static_assert(sizeof(T) * N % 4 == 0, "glTF aligns vertices to 4 bytes");
  tinygltf::Accessor accessor;
  accessor.bufferView =
      add_view(values.data(), values.size(), sizeof(T) * N, TINYGLTF_TARGET_ARRAY_BUFFER);
  accessor.componentType = component_type<T>();
  accessor.normalized = is_normalized;
  accessor.count = values.size();
  accessor.type = kTypes[components];
  for (std::size_t c = 0; c < components && has_bounds; ++c) {
    const auto [low, high] = std::minmax_element(
        values.begin(), values.end(), [c](const auto& a, const auto& b) { return a[c] < b[c]; });
    accessor.minValues.push_back((*low)[c]);
    accessor.maxValues.push_back((*high)[c]);
  }
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int GltfBuffers::add_positions(const std::vector<std::array<float, 3>>& positions,
                               const PositionGrid& grid) {
  if (compression_ == GltfCompression::none) return add_attribute(positions, 3, false, true);
  std::vector<std::array<std::uint16_t, 4>> steps(positions.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      steps[i][c] = quantized((positions[i][c] - grid.offset[c]) / (grid.scale * kMost));
    }
  }
  return add_attribute(steps, 3, false, true);
}

int GltfBuffers::add_normals(const std::vector<std::array<float, 3>>& normals) {
  if (compression_ == GltfCompression::none) return add_attribute(normals, 3, false, false);
  std::vector<std::array<std::int16_t, 4>> steps(normals.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      steps[i][c] = static_cast<std::int16_t>(std::lround(32767.0 * normals[i][c]));
    }
  }
  return add_attribute(steps, 3, true, false);
}

int GltfBuffers::add_texture_coordinates(const std::vector<std::array<float, 2>>& coordinates) {
  const bool is_inside = std::all_of(coordinates.begin(), coordinates.end(), [](const auto& uv) {
    return std::min(uv[0], uv[1]) >= 0 && std::max(uv[0], uv[1]) <= 1;
  });
  if (compression_ == GltfCompression::none || !is_inside) {
    return add_attribute(coordinates, 2, false, false);
  }
  std::vector<std::array<std::uint16_t, 2>> steps(coordinates.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i] = {quantized(coordinates[i][0]), quantized(coordinates[i][1])};
  }
  return add_attribute(steps, 2, true, false);
}

int GltfBuffers::add_colors(const std::vector<std::array<float, 4>>& colors) {
  std::vector<std::array<std::uint16_t, 4>> steps(colors.size());
  bool is_opaque = true;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (int c = 0; c < 4; ++c) steps[i][c] = quantized(colors[i][c]);
    is_opaque &= steps[i][3] == kMost;
  }
  return add_attribute(steps, is_opaque ? 3 : 4, true, false);
}

int GltfBuffers::add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertex_count) {
  tinygltf::Accessor accessor;
  // 65535 is the value that restarts a strip, so the largest 16-bit index is 65534.
  if (vertex_count <= 65535) {
    const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
    accessor.bufferView = add_view(narrow.data(), narrow.size(), sizeof(std::uint16_t),
                                   TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  } else {
    accessor.bufferView = add_view(indices.data(), indices.size(), sizeof(std::uint32_t),
                                   TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  }
  accessor.count = indices.size();
  accessor.type = TINYGLTF_TYPE_SCALAR;
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int GltfBuffers::add_file(const std::vector<std::uint8_t>& bytes) {
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = append(bytes.data(), bytes.size());
  view.byteLength = bytes.size();
  model_.bufferViews.push_back(std::move(view));
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

}  // namespace quadrille
