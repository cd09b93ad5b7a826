#include "smooth_drawing.h"

#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quadrille::viewer {
namespace {

using Eigen::Vector2d;

constexpr double kFade = 0.5;  // pixels on either side of an edge over which it fades

Vector2d normal_of(const Vector2d& from, const Vector2d& to) {
  const Vector2d along = (to - from).stableNormalized();
  return {-along.y(), along.x()};
}

/// Where the offset lines of both neighbouring segments meet, per distance; no longer than 2.
Vector2d mitre(std::span<const Vector2d> points, std::size_t i) {
  const Vector2d before = i > 0 ? normal_of(points[i - 1], points[i]) : Vector2d(0, 0);
  const Vector2d after =
      i + 1 < points.size() ? normal_of(points[i], points[i + 1]) : Vector2d(0, 0);
  if (i == 0) return after;
  if (i + 1 == points.size()) return before;
  return (before + after) / std::max(1 + before.dot(after), 0.5);
}

}  // namespace

SmoothDrawing::SmoothDrawing(double height) : height_(height) { colors_->SetNumberOfComponents(4); }

void SmoothDrawing::add_line(std::span<const Vector2d> points, double width, const Ink& ink) {
  const double solid = std::max(width / 2 - kFade, 0.0),
               outside = std::max(width / 2, kFade) + kFade;
  const std::array<double, 4> all = {-outside, -solid, solid, outside};
  const std::array<double, 3> thin = {-outside, 0, outside};
  const std::span<const double> offsets = solid > 0 ? std::span<const double>(all) : thin;
  const auto rows = static_cast<vtkIdType>(offsets.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d aside = mitre(points, i);
    for (const double offset : offsets) {
      const vtkIdType p = add_point(points[i] + offset * aside, ink, std::abs(offset) < outside);
      if (i > 0 && offset > offsets.front()) add_quad(p - rows - 1, p - rows, p, p - 1);
    }
  }
}

void SmoothDrawing::add_disc(const Vector2d& center, double radius, const Ink& ink) {
  constexpr int kCorners = 20;
  const double solid = std::max(radius - kFade, 0.0);
  std::array<vtkIdType, kCorners> inner, outer;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCorners;
    const Vector2d direction(std::cos(angle), std::sin(angle));
    inner[k] = add_point(center + solid * direction, ink, true);
    outer[k] = add_point(center + (radius + kFade) * direction, ink, false);
  }
  polygons_->InsertNextCell(kCorners, inner.data());
  for (int k = 0; k < kCorners; ++k) {
    const int next = (k + 1) % kCorners;
    add_quad(inner[k], inner[next], outer[next], outer[k]);
  }
}

vtkSmartPointer<vtkActor> SmoothDrawing::finish() {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_);
  data->SetPolys(polygons_);
  data->GetPointData()->SetScalars(colors_);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  // VTK blends opaque actors, too, one over the other, but translucent ones in no order.
  actor->ForceOpaqueOn();
  return actor;
}

vtkIdType SmoothDrawing::add_point(const Vector2d& p, const Ink& ink, bool solid) {
  for (const int c : ink) colors_->InsertNextValue(static_cast<unsigned char>(c));
  colors_->InsertNextValue(solid ? 255 : 0);
  return points_->InsertNextPoint(p.x(), height_ - p.y(), 0);
}

void SmoothDrawing::add_quad(vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d) {
  const vtkIdType corners[4] = {a, b, c, d};
  polygons_->InsertNextCell(4, corners);
}

}  // namespace quadrille::viewer
