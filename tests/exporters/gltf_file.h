#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/export.h"
#include "quadrille/raster.h"

namespace quadrille::test {

/// A glTF file taken apart by the letter of the specification: a binary one (section 4.4), or a
/// .gltf with the files beside it. Compressed buffer views (EXT_meshopt_compression) are decoded by
/// meshoptimizer.
class GltfFile {
 public:
  explicit GltfFile(const std::filesystem::path& path);

  /// The elements of an accessor, normalised ones divided by their largest value.
  std::vector<std::vector<double>> values(int accessor) const;
  std::vector<std::uint32_t> indices(int accessor) const;
  const nlohmann::json& primitive(int mesh, int index = 0) const {
    return gltf["meshes"][mesh]["primitives"][index];
  }
  std::size_t primitive_count(int mesh) const { return gltf["meshes"][mesh]["primitives"].size(); }
  /// An attribute of a primitive of mesh 0; positions as the node places them.
  std::vector<std::vector<double>> attribute(int primitive, const std::string& name) const;
  std::vector<std::uint32_t> triangles(int primitive) const;
  /// The bytes of a picture's file, and the picture.
  std::string image_bytes(int index) const;
  Raster image(int index) const;
  std::string view(int index) const;

  std::filesystem::path path;
  std::string bytes;  ///< of the file itself
  nlohmann::json gltf;

 private:
  std::uint32_t word(std::size_t at) const;
  std::string unpacked(const nlohmann::json& view) const;

  std::string binary_;
};

/// Writes the picture to a new file of the scratch folder.
GltfFile written(const VectorImage& image, const GltfOptions& options = {},
                 const RunContext& context = {}, const std::string& ending = ".glb");

/// A disc of random colours over a background of others, 40 x 32 pixels, torn along the circle, its
/// edges smoothly curved.
VectorImage torn_disc(bool is_opaque);

/// The polygons of FB_ngon_encoding: consecutive triangles that start with the same vertex, as
/// rings of vertices.
std::vector<std::vector<std::uint32_t>> polygons(const std::vector<std::uint32_t>& triangles);

/// The sides of triangles that no other triangle runs the other way, over all primitives of mesh 0,
/// vertices of equal position taken for one: the border of the surface, as pairs of positions.
/// Sides that two triangles run the same way count in `repeated`.
using Place = std::vector<double>;
std::vector<std::pair<Place, Place>> open_sides(const GltfFile& file, int* repeated = nullptr);

}  // namespace quadrille::test
