#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>

#include "quadrille/atomic_file.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "quadrille/quad_mesh.h"
#include "vtk_display_colors.h"
#include "vtk_points.h"

namespace quadrille {
namespace {

constexpr char kConventions[] =
    "Bicubic Bezier patches, 1 unit = 1 pixel, y up. Colours are sRGB-encoded control values in "
    "0..1, interpolated like the positions; fitted values may leave 0..1. color_premultiplied is "
    "multiplied by alpha; rgba is the nearest straight 8-bit approximation.";

/// The arrays of the grid while layer after layer is added.
class GridBuilder {
 public:
  GridBuilder(const VectorImage& image, bool opaque) : height_(image.height) {
    points_->SetDataTypeToDouble();
    color_->SetName(opaque ? "color" : "color_premultiplied");
    color_->SetNumberOfComponents(opaque ? 3 : 4);
    rgba_->SetName("rgba");
    rgba_->SetNumberOfComponents(4);
    patch_->SetName("patch");
    layer_->SetName("layer");
    jacobian_->SetName("scaled_jacobian");
    size_->SetName("picture_size");
    size_->InsertNextValue(image.width);
    size_->InsertNextValue(image.height);
    conventions_->SetName("conventions");
    conventions_->InsertNextValue(kConventions);
  }

  /// Layers are stacked one unit apart, because surfaces of equal depth would flicker.
  void add(const Layer& layer, int index) {
    const ControlPoints control = control_points(layer, height_);
    const vtkIdType first = points_->GetNumberOfPoints();
    for (const Eigen::Vector2d& p : control.position) points_->InsertNextPoint(p.x(), p.y(), index);
    for (const Color& c : control.color) color_->InsertNextTypedTuple(c.data());
    for (const auto& c : display_colors(control)) rgba_->InsertNextTypedTuple(c.data());
    for (int q = 0; q < layer.patches.patch_count(); ++q) {
      cells_->InsertNextCell(16);
      for (const int id : control.cells[q]) cells_->InsertCellPoint(first + id);
      patch_->InsertNextValue(q);
      layer_->InsertNextValue(index);
      jacobian_->InsertNextValue(scaled_jacobian(layer.patches.mesh, q));
    }
  }

  vtkNew<vtkUnstructuredGrid> build() {
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points_);
    grid->SetCells(VTK_BEZIER_QUADRILATERAL, cells_);
    grid->GetPointData()->SetScalars(rgba_);
    grid->GetPointData()->AddArray(color_);
    grid->GetCellData()->AddArray(patch_);
    grid->GetCellData()->AddArray(layer_);
    grid->GetCellData()->AddArray(jacobian_);
    grid->GetFieldData()->AddArray(size_);
    grid->GetFieldData()->AddArray(conventions_);
    return grid;
  }

 private:
  double height_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
  vtkNew<vtkFloatArray> color_;
  vtkNew<vtkUnsignedCharArray> rgba_;
  vtkNew<vtkIntArray> patch_, layer_;
  vtkNew<vtkDoubleArray> jacobian_, size_;
  vtkNew<vtkStringArray> conventions_;
};

/// Keeps VTK's messages from the terminal: an object with an error observer does not print them.
class SilentObserver : public vtkCommand {
 public:
  static SilentObserver* New() { return new SilentObserver; }
  void Execute(vtkObject*, unsigned long, void*) override {}
};

/// The file's bytes; the writer's own errors of a full disk would name the temporary.
std::string grid_file(vtkUnstructuredGrid* grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  vtkNew<SilentObserver> silent;
  writer->AddObserver(vtkCommand::ErrorEvent, silent);
  writer->WriteToOutputStringOn();
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetHeaderTypeToUInt64();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0) {
    throw Error(ErrorCode::numerical_failure, "VTK cannot write these patches; report the picture");
  }
  return writer->GetOutputString();
}

}  // namespace

void write_vtu(const VectorImage& image, const std::filesystem::path& path, const VtkOptions&,
               const RunContext& context) {
  const bool opaque = std::all_of(image.layers.begin(), image.layers.end(),
                                  [](const Layer& layer) { return layer.patches.opaque; });
  GridBuilder builder(image, opaque);
  int index = 0;
  for (const Layer& layer : image.layers) {
    context.progress("vtu", double(index) / image.layers.size());
    builder.add(layer, index++);
  }
  const auto grid = builder.build();
  const std::string file = grid_file(grid);
  write_stream_atomically(path, [&](std::ostream& stream) { stream << file; });
  context.progress("vtu", 1);
}

}  // namespace quadrille
