#include "vtk_patch_grid.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <string>

#include "quadrille/error.h"
#include "quadrille/mesh_region.h"
#include "vtk_arrays.h"
#include "vtk_display_colors.h"
#include "vtk_points.h"
#include "vtk_state.h"

namespace quadrille {
namespace {

constexpr char kConventions[] =
    "Bicubic Bezier patches, 1 unit = 1 pixel, y up, the picture's bottom left corner at the "
    "origin, layer k at z = k. Colours are sRGB-encoded control values in 0..1, interpolated like "
    "the positions; fitted values may leave 0..1. color_premultiplied is multiplied by alpha; rgba "
    "is the nearest straight 8-bit approximation. The field arrays hold the patches bit for bit, "
    "in pixels with y down.";

/// The arrays of the grid while layer after layer is added.
class GridBuilder {
 public:
  GridBuilder(const VectorImage& image, const std::vector<float>& errors)
      : height_(image.height), errors_(errors) {
    const bool opaque =
        std::ranges::all_of(image.layers, [](const Layer& layer) { return layer.patches.opaque; });
    color_ = opaque ? named_array<vtkFloatArray>("color", 3, "sRGB-encoded, 0 to 1")
                    : named_array<vtkFloatArray>("color_premultiplied", 4,
                                                 "sRGB-encoded times alpha, and alpha, 0 to 1");
    points_->SetDataTypeToDouble();
  }

  /// Layers are stacked one unit apart, because surfaces of equal depth would flicker.
  void add(const Layer& layer, int index) {
    const ControlPoints control = control_points(layer, height_);
    const vtkIdType first = points_->GetNumberOfPoints();
    for (const Eigen::Vector2d& p : control.position) points_->InsertNextPoint(p.x(), p.y(), index);
    for (const Color& c : control.color) color_->InsertNextTypedTuple(c.data());
    for (const auto& c : display_colors(control)) rgba_->InsertNextTypedTuple(c.data());
    const std::vector<int> regions = smooth_regions(layer.patches.mesh);
    const bool mirrored = layer.transform.linear().determinant() < 0;
    for (int q = 0; q < layer.patches.patch_count(); ++q) {
      cells_->InsertNextCell(16);
      for (const int id : control.cells[q]) cells_->InsertCellPoint(first + id);
      patch_->InsertNextValue(q);
      layer_->InsertNextValue(index);
      region_->InsertNextValue(regions[q]);
      jacobian_->InsertNextValue(static_cast<float>(scaled_jacobian(layer.patches.mesh, q)));
      add_valences(layer.patches.mesh, q, mirrored);
    }
  }

  vtkSmartPointer<vtkUnstructuredGrid> build() {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(points_);
    grid->SetCells(VTK_BEZIER_QUADRILATERAL, cells_);
    grid->GetPointData()->SetScalars(rgba_);
    grid->GetPointData()->AddArray(color_);
    for (vtkDataArray* array :
         std::initializer_list<vtkDataArray*>{patch_, layer_, region_, jacobian_, valence_}) {
      grid->GetCellData()->AddArray(array);
    }
    if (!errors_.empty()) {
      const auto error = named_array<vtkFloatArray>(
          "fitting_error", 1, "root mean square difference from the source, 0 to 255");
      for (const float value : errors_) error->InsertNextValue(value);
      grid->GetCellData()->AddArray(error);
    }
    grid->GetFieldData()->AddArray(string_array("conventions", {kConventions}));
    return grid;
  }

 private:
  /// VTK's corners follow each other counter-clockwise from the first, so the other way round than
  /// those of a patch unless its layer mirrors.
  void add_valences(const QuadMesh& mesh, int q, bool mirrored) {
    const QuadMesh::Quad& c = mesh.quads()[q];
    const int valences[4] = {mesh.valence(c[0]), mesh.valence(c[mirrored ? 1 : 3]),
                             mesh.valence(c[2]), mesh.valence(c[mirrored ? 3 : 1])};
    valence_->InsertNextTypedTuple(valences);
  }

  double height_;
  const std::vector<float>& errors_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
  vtkSmartPointer<vtkFloatArray> color_;
  vtkSmartPointer<vtkUnsignedCharArray> rgba_ = named_array<vtkUnsignedCharArray>(
      "rgba", 4, "straight sRGB bytes, and alpha, as near as bytes come");
  vtkSmartPointer<vtkIntArray> patch_ =
      named_array<vtkIntArray>("patch", 1, "number of the patch in its layer");
  vtkSmartPointer<vtkIntArray> layer_ =
      named_array<vtkIntArray>("layer", 1, "layer of the picture, from 0");
  vtkSmartPointer<vtkIntArray> region_ = named_array<vtkIntArray>(
      "region", 1, "smooth region of the layer that tears and the border bound, from 0");
  vtkSmartPointer<vtkFloatArray> jacobian_ = named_array<vtkFloatArray>(
      "scaled_jacobian", 1, "smallest sine of the corner angles, 1 for a rectangle");
  vtkSmartPointer<vtkIntArray> valence_ = named_array<vtkIntArray>(
      "valence", 4, "edges at the vertices at the cell's first four points");
};

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> patch_grid(const VectorImage& image,
                                                const std::vector<float>& errors,
                                                const RunContext& context) {
  if (!errors.empty() && errors.size() != static_cast<std::size_t>(image.patch_count())) {
    throw Error(ErrorCode::invalid_argument,
                "there are " + std::to_string(errors.size()) + " fitting errors for " +
                    std::to_string(image.patch_count()) + " patches; give one for each or none");
  }
  GridBuilder builder(image, errors);
  int index = 0;
  for (const Layer& layer : image.layers) {
    context.progress("patches", static_cast<double>(index) / image.layers.size());
    builder.add(layer, index++);
  }
  const auto grid = builder.build();
  store_state(image, grid);
  return grid;
}

}  // namespace quadrille
