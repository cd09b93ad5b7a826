#include "vtk_scene_data.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <charconv>
#include <string>

#include "vtk_arrays.h"
#include "vtk_patch_grid.h"

namespace quadrille {
namespace {

void add_arrays(vtkDataSetAttributes* data, const std::vector<SceneArray>& arrays,
                const SceneStyle& style) {
  for (const SceneArray& array : arrays) {
    const auto copy = to_vtk(array);
    data->AddArray(copy);
    if (array.name == style.colors) data->SetScalars(copy);
  }
}

vtkSmartPointer<vtkCellArray> cells_of(const SceneShapes& shapes) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  if (shapes.cell == SceneShapes::Cell::point) {
    for (std::size_t i = 0; i < shapes.points.size(); ++i) {
      const auto id = static_cast<vtkIdType>(i);
      cells->InsertNextCell(1, &id);
    }
    return cells;
  }
  cells->AllocateExact(shapes.cell_count(), static_cast<vtkIdType>(shapes.cell_points.size()));
  for (int c = 0; c < shapes.cell_count(); ++c) {
    const int begin = shapes.cell_begin[c], end = shapes.cell_begin[c + 1];
    cells->InsertNextCell(end - begin);
    // y up turns polygons around.
    const bool turned = shapes.cell == SceneShapes::Cell::polygon;
    for (int k = begin; k < end; ++k) {
      cells->InsertCellPoint(shapes.cell_points[turned ? begin + end - 1 - k : k]);
    }
  }
  return cells;
}

vtkSmartPointer<vtkDataSet> poly_data(const SceneShapes& shapes, const SceneStyle& style,
                                      double picture_height) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(shapes.points.size()));
  for (std::size_t i = 0; i < shapes.points.size(); ++i) {
    const Eigen::Vector2d& p = shapes.points[i];
    points->SetPoint(static_cast<vtkIdType>(i), p.x(), picture_height - p.y(),
                     shapes.heights.empty() ? 0.0 : shapes.heights[i]);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  const auto cells = cells_of(shapes);
  switch (shapes.cell) {
    case SceneShapes::Cell::point:
      data->SetVerts(cells);
      break;
    case SceneShapes::Cell::line:
      data->SetLines(cells);
      break;
    case SceneShapes::Cell::polygon:
      data->SetPolys(cells);
      break;
  }
  add_arrays(data->GetPointData(), shapes.point_arrays, style);
  add_arrays(data->GetCellData(), shapes.cell_arrays, style);
  return data;
}

/// VTK's rows begin at the bottom.
template <class T>
std::vector<T> upside_down(const std::vector<T>& values, std::size_t rows) {
  const std::size_t row = values.size() / rows;
  std::vector<T> turned(values.size());
  for (std::size_t j = 0; j < rows; ++j) {
    std::copy_n(values.begin() + j * row, row, turned.begin() + (rows - 1 - j) * row);
  }
  return turned;
}

vtkSmartPointer<vtkDataSet> image_data(const SceneGrid& grid, const SceneStyle& style,
                                       double picture_height) {
  auto data = vtkSmartPointer<vtkImageData>::New();
  data->SetDimensions(grid.width + 1, grid.height + 1, 1);
  data->SetSpacing(grid.pixel_width, grid.pixel_height, 1);
  data->SetOrigin(0, picture_height - grid.height * grid.pixel_height, 0);
  std::vector<SceneArray> arrays = grid.arrays;
  for (SceneArray& array : arrays) {
    array.values = std::visit(
        [&](const auto& values) -> SceneArray::Values { return upside_down(values, grid.height); },
        array.values);
  }
  add_arrays(data->GetCellData(), arrays, style);
  return data;
}

std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

const char* name_of(Marker marker) {
  switch (marker) {
    case Marker::dot:
      return "dot";
    case Marker::mark:
      return "mark";
    case Marker::ring:
      return "ring";
    case Marker::cross:
      return "cross";
  }
  return "";
}

/// Lines of a key and its value, for programs that draw the layer.
std::string text_of(const SceneStyle& style) {
  const Ink& i = style.ink;
  std::string text = "ink " + std::to_string(i[0]) + " " + std::to_string(i[1]) + " " +
                     std::to_string(i[2]) + "\nwidth " + number(style.width) + "\nmarker " +
                     name_of(style.marker) + "\nradius " + number(style.radius) + "\narm_length " +
                     number(style.arm_length);
  if (!style.colors.empty()) text += "\ncolors " + style.colors;
  return text;
}

}  // namespace

vtkSmartPointer<vtkDataSet> scene_data(const SceneLayer& layer, double picture_height,
                                       const RunContext& context) {
  vtkSmartPointer<vtkDataSet> data;
  if (const auto* patches = std::get_if<ScenePatches>(&layer.content)) {
    data = patch_grid(*patches->image, patches->errors, context);
  } else {
    const auto* grid = std::get_if<SceneGrid>(&layer.content);
    data = grid ? image_data(*grid, layer.style, picture_height)
                : poly_data(std::get<SceneShapes>(layer.content), layer.style, picture_height);
    data->GetFieldData()->AddArray(string_array("style", {text_of(layer.style)}));
  }
  data->GetFieldData()->AddArray(string_array("summary", {layer.summary}));
  return data;
}

}  // namespace quadrille
