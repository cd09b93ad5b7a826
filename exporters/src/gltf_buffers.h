#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gltf_surface.h"
#include "quadrille/export.h"

namespace tinygltf {
class Model;
}

namespace quadrille {

/// How positions and texture coordinates become what the file holds: positions are quantised to 16
/// bits over the box's longest side (KHR_mesh_quantization), so that the node of the mesh has to
/// scale by `scale` and translate by `offset`.
struct PositionGrid {
  std::array<double, 3> offset = {0, 0, 0};
  double scale = 1;
};

/// The grid around all parts.
PositionGrid position_grid(const std::vector<SurfacePart>& parts);

/// A buffer view that the file holds compressed (EXT_meshopt_compression).
struct PackedView {
  int view = 0;
  std::size_t offset = 0;  ///< in buffer 0
  std::size_t size = 0;    ///< there
  std::size_t count = 0;
  std::size_t stride = 0;
  bool is_vertices = true;
};

/// Collects the binary data of a file and describes it in the model: buffer views and accessors.
/// Buffer 0 holds what the file holds; buffer 1, with EXT_meshopt_compression, stands for what its
/// reader decompresses and is nowhere stored.
class GltfBuffers {
 public:
  GltfBuffers(tinygltf::Model& model, GltfCompression compression)
      : model_(model), compression_(compression) {}

  /// Each of them returns the index of the accessor.
  int add_positions(const std::vector<std::array<float, 3>>& positions, const PositionGrid& grid);
  int add_normals(const std::vector<std::array<float, 3>>& normals);
  /// Within [0, 1] they are stored in 16 bits when anything is compressed.
  int add_texture_coordinates(const std::vector<std::array<float, 2>>& coordinates);
  /// 16 bits a channel; without alpha when it is 1 everywhere.
  int add_colors(const std::vector<std::array<float, 4>>& colors);
  int add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertex_count);

  /// The bytes of a picture, as they are; returns the index of the buffer view.
  int add_file(const std::vector<std::uint8_t>& bytes);

  const std::vector<unsigned char>& bytes() const { return bytes_; }
  const std::vector<PackedView>& packed() const { return packed_; }
  /// Bytes of buffer 1, 0 when there is none.
  std::size_t decompressed_size() const { return decompressed_size_; }

 private:
  template <class T, std::size_t N>
  int add_attribute(const std::vector<std::array<T, N>>& values, std::size_t components,
                    bool is_normalized, bool has_bounds);
  int add_view(const void* data, std::size_t count, std::size_t stride, int target);
  std::size_t append(const void* data, std::size_t size);

  tinygltf::Model& model_;
  GltfCompression compression_;
  std::vector<unsigned char> bytes_;
  std::vector<PackedView> packed_;
  std::size_t decompressed_size_ = 0;
};

}  // namespace quadrille
