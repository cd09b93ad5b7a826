#include "vtk_state.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "quadrille/error.h"
#include "vtk_array_file.h"
#include "vtk_arrays.h"

namespace quadrille {
namespace {

constexpr int kVersion = 1;
constexpr char kVersionArray[] = "quadrille_patches";

using EdgeTangents = std::array<Eigen::Vector2d, 2>;
static_assert(sizeof(EdgeTangents) == 4 * sizeof(double));
static_assert(sizeof(Wedge) == 16 * sizeof(float));

/// Adds the numbers of the elements as tuples of an array.
template <class Array, class Element>
void store(vtkFieldData* data, const std::string& name, const char* meaning, int components,
           const std::vector<Element>& elements) {
  const auto array = named_array<Array>(name.c_str(), components, meaning);
  array->SetNumberOfTuples(static_cast<vtkIdType>(elements.size()));
  if (!elements.empty()) {
    std::memcpy(array->GetVoidPointer(0), elements.data(), elements.size() * sizeof(Element));
  }
  data->AddArray(array);
}

std::string layer_array(std::size_t layer, const char* what) {
  return "layer" + std::to_string(layer) + "_" + what;
}

void check_text(const std::string& text) {
  if (text.find('\0') == std::string::npos) return;
  throw Error(
      ErrorCode::invalid_argument,
      "a name or an entry of the metadata holds a zero byte, which VTK files cannot; remove "
      "it");
}

void store_texts(const VectorImage& image, vtkFieldData* data) {
  std::vector<std::string> names, metadata;
  for (const Layer& layer : image.layers) names.push_back(layer.name);
  for (const auto& [key, value] : image.metadata) metadata.insert(metadata.end(), {key, value});
  for (const auto* texts : {&names, &metadata}) {
    for (const std::string& text : *texts) check_text(text);
  }
  data->AddArray(string_array("layer_names", names));
  data->AddArray(string_array("metadata", metadata));
}

void store_layer(const Layer& layer, std::size_t index, vtkFieldData* data) {
  const auto name = [&](const char* what) { return layer_array(index, what); };
  const auto& m = layer.transform.matrix();
  const PatchMesh& patches = layer.patches;
  store<vtkDoubleArray>(
      data, name("transform"),
      "x = m0 X + m1 Y + m2, y = m3 X + m4 Y + m5, from the mesh to pixels", 6,
      std::vector<std::array<double, 6>>{{m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2)}});
  store<vtkUnsignedCharArray>(data, name("opaque"), "1 when alpha is 1 everywhere", 1,
                              std::vector<std::uint8_t>{patches.opaque});
  store<vtkDoubleArray>(data, name("vertices"), "x and y down, pixels", 2, patches.mesh.vertices);
  store<vtkUnsignedCharArray>(data, name("edge_flags"), "1 feature, 2 tear, summed", 1,
                              patches.mesh.edge_flags);
  store<vtkDoubleArray>(data, name("edge_tangents"),
                        "derivative of the edge's curve at its start and at its end, pixels", 4,
                        patches.edge_tangents);
  store<vtkFloatArray>(data, name("wedges"),
                       "premultiplied colour, its d/dx, d/dy per pixel, twist per square pixel", 16,
                       patches.wedges);
}

using Part = VtkArrayFile::Part;

template <class Number, class Element>
Element single(const VtkArrayFile& file, const std::string& array) {
  const auto values = file.elements<Number, Element>(Part::field, array);
  if (values.size() != 1) file.refuse("the array '" + array + "' has a wrong size");
  return values.front();
}

/// The corners of the cells: those of all layers, one after the other.
struct Corners {
  std::vector<int> layer;
  std::vector<QuadMesh::Quad> vertices, wedges;
};

Layer restore_layer(const VtkArrayFile& file, std::size_t index, const Corners& corners) {
  const auto name = [&](const char* what) { return layer_array(index, what); };
  Layer layer;
  const auto m = single<double, std::array<double, 6>>(file, name("transform"));
  layer.transform.matrix() << m[0], m[1], m[2], m[3], m[4], m[5], 0, 0, 1;
  if (!layer.transform.matrix().allFinite()) file.refuse("a transform is not finite");
  PatchMesh& patches = layer.patches;
  patches.opaque = single<std::uint8_t, std::uint8_t>(file, name("opaque")) != 0;

  std::vector<QuadMesh::Quad> quads;
  for (std::size_t c = 0; c < corners.layer.size(); ++c) {
    if (corners.layer[c] != static_cast<int>(index)) continue;
    quads.push_back(corners.vertices[c]);
    patches.wedge_of_corner.insert(patches.wedge_of_corner.end(), corners.wedges[c].begin(),
                                   corners.wedges[c].end());
  }
  auto vertices = file.elements<double, Eigen::Vector2d>(Part::field, name("vertices"));
  try {
    patches.mesh = QuadMesh(std::move(vertices), std::move(quads));
  } catch (const Error& error) {
    file.refuse(error.what());
  }
  patches.mesh.edge_flags =
      file.elements<std::uint8_t, std::uint8_t>(Part::field, name("edge_flags"));
  patches.edge_tangents = file.elements<double, EdgeTangents>(Part::field, name("edge_tangents"));
  patches.wedges = file.elements<float, Wedge>(Part::field, name("wedges"));
  const std::string contradiction = contradiction_in(patches);
  if (!contradiction.empty()) file.refuse(contradiction);
  return layer;
}

Corners restore_corners(const VtkArrayFile& file, std::size_t layers) {
  Corners corners;
  corners.layer = file.elements<int, int>(Part::cell, "layer");
  corners.vertices = file.elements<int, QuadMesh::Quad>(Part::cell, "corner_vertices");
  corners.wedges = file.elements<int, QuadMesh::Quad>(Part::cell, "corner_wedges");
  const std::size_t count = file.cell_count();
  if (corners.layer.size() != count || corners.vertices.size() != count ||
      corners.wedges.size() != count) {
    file.refuse("arrays of its cells are missing");
  }
  for (const int layer : corners.layer) {
    if (layer < 0 || static_cast<std::size_t>(layer) >= layers) {
      file.refuse("a layer is out of range");
    }
  }
  return corners;
}

}  // namespace

void store_state(const VectorImage& image, vtkUnstructuredGrid* grid) {
  vtkFieldData* const fields = grid->GetFieldData();
  store<vtkIntArray>(fields, kVersionArray, "version of the arrays that hold the patches", 1,
                     std::vector<int>{kVersion});
  store<vtkDoubleArray>(fields, "picture_size", "width and height, pixels", 2,
                        std::vector<std::array<double, 2>>{{image.width, image.height}});
  store_texts(image, fields);
  std::vector<QuadMesh::Quad> vertices;
  std::vector<int> wedges;
  for (std::size_t l = 0; l < image.layers.size(); ++l) {
    const PatchMesh& patches = image.layers[l].patches;
    store_layer(image.layers[l], l, fields);
    vertices.insert(vertices.end(), patches.mesh.quads().begin(), patches.mesh.quads().end());
    wedges.insert(wedges.end(), patches.wedge_of_corner.begin(), patches.wedge_of_corner.end());
  }
  std::vector<QuadMesh::Quad> wedge_corners(vertices.size());
  if (!wedges.empty()) {
    std::memcpy(wedge_corners.data(), wedges.data(), wedges.size() * sizeof(int));
  }
  store<vtkIntArray>(grid->GetCellData(), "corner_vertices",
                     "vertices of the layer at (u, v) = (0,0), (1,0), (1,1), (0,1)", 4, vertices);
  store<vtkIntArray>(grid->GetCellData(), "corner_wedges", "wedges of the layer at these corners",
                     4, wedge_corners);
}

VectorImage restore_state(const VtkArrayFile& file) {
  if (!file.has(Part::field, kVersionArray)) file.refuse_content("no patches of Quadrille");
  const int version = single<int, int>(file, kVersionArray);
  if (version != kVersion) {
    file.refuse_content("patches in version " + std::to_string(version) +
                        " of the arrays, and this program knows version " +
                        std::to_string(kVersion));
  }
  VectorImage image;
  const auto size = single<double, std::array<double, 2>>(file, "picture_size");
  for (const double side : size) {
    if (!std::isfinite(side) || side <= 0) file.refuse("its size is not positive");
  }
  image.width = size[0];
  image.height = size[1];
  const std::vector<std::string> metadata = file.texts("metadata");
  if (metadata.size() % 2 != 0) file.refuse("its metadata has a key without a value");
  for (std::size_t i = 0; i < metadata.size(); i += 2)
    image.metadata[metadata[i]] = metadata[i + 1];
  const std::vector<std::string> names = file.texts("layer_names");
  const Corners corners = restore_corners(file, names.size());
  for (std::size_t l = 0; l < names.size(); ++l) {
    image.layers.push_back(restore_layer(file, l, corners));
    image.layers.back().name = names[l];
  }
  return image;
}

}  // namespace quadrille
