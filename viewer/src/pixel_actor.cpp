#include "pixel_actor.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>

namespace quadrille::viewer {
namespace {

constexpr int kMargin = 192;  // pixels drawn around the window

vtkSmartPointer<vtkPolyData> rectangle() {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(4);
  vtkNew<vtkFloatArray> texels;
  texels->SetNumberOfComponents(2);
  texels->SetNumberOfTuples(4);
  vtkNew<vtkCellArray> cells;
  const vtkIdType corners[4] = {0, 1, 2, 3};
  cells->InsertNextCell(4, corners);
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetTCoords(texels);
  return data;
}

}  // namespace

PixelActor::PixelActor()
    : rectangle_(rectangle()),
      texture_(vtkSmartPointer<vtkTexture>::New()),
      actor_(vtkSmartPointer<vtkActor>::New()) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(rectangle_);
  texture_->InterpolateOff();
  texture_->RepeatOff();
  texture_->EdgeClampOn();
  texture_->SetColorModeToDirectScalars();
  actor_->SetMapper(mapper);
  actor_->SetTexture(texture_);
  actor_->GetProperty()->LightingOff();
  // VTK blends opaque actors, too, one over the other, but translucent ones in no order.
  actor_->ForceOpaqueOn();
}

bool PixelActor::place(const Frame& frame, const RegionCache::Draw& draw, int first, int last) {
  if (scale_x_ != frame.scale.x() || scale_y_ != frame.scale.y()) {
    forget();
    scale_x_ = frame.scale.x();
    scale_y_ = frame.scale.y();
  }
  const PixelRegion visible = frame.visible();
  const PixelRegion part =
      intersection(visible, {first - frame.origin.x(), visible.y, last - first, visible.height});
  if (part.width == 0 || part.height == 0) return false;
  // The first pixels at a scale come without a margin: zooming goes on to other scales.
  const bool is_new = cache_.pixels().empty();
  if (cache_.cover(visible, frame.visible(is_new ? 0 : kMargin), draw)) upload();
  set_rectangle(frame, part);
  return true;
}

void PixelActor::set_opacity(double opacity) { actor_->GetProperty()->SetOpacity(opacity); }

void PixelActor::upload() {
  vtkNew<vtkImageData> image;
  image->SetDimensions(cache_.region().width, cache_.region().height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  std::ranges::copy(cache_.pixels(), static_cast<std::uint8_t*>(image->GetScalarPointer()));
  texture_->SetInputData(image);
}

void PixelActor::set_rectangle(const Frame& frame, const PixelRegion& part) {
  const PixelRegion& drawn = cache_.region();
  vtkPoints* points = rectangle_->GetPoints();
  vtkDataArray* texels = rectangle_->GetPointData()->GetTCoords();
  for (int corner = 0; corner < 4; ++corner) {
    const int x = part.x + (corner == 1 || corner == 2 ? part.width : 0);
    const int y = part.y + (corner >= 2 ? part.height : 0);
    points->SetPoint(corner, x + frame.origin.x(), frame.window.y() - (y + frame.origin.y()), 0);
    texels->SetTuple2(corner, static_cast<double>(x - drawn.x) / drawn.width,
                      static_cast<double>(y - drawn.y) / drawn.height);
  }
  points->Modified();
  texels->Modified();
  rectangle_->Modified();
}

}  // namespace quadrille::viewer
