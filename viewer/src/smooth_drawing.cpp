#include "smooth_drawing.h"

#include <vtkDataObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace quadrille::viewer {
namespace {

using Eigen::Vector2d;

constexpr double kFade = 0.5;  // pixels on either side of an edge over which it fades
constexpr char kAside[] = "aside";

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

/// The opacity falls from 1 to 0 over the last pixel before the edge. That the fragment shader does
/// it saves the triangles whose corners would: most of the time is theirs where a processor draws.
void fade_edges(vtkShaderProperty* shaders) {
  const std::string name = kAside;
  const auto after = [](const std::string& mark, const std::string& code) {
    return mark + "\n" + code + "\n";
  };
  const std::string declarations = "//VTK::PositionVC::Dec", positions = "//VTK::PositionVC::Impl",
                    inputs = "//VTK::Color::Dec", output = "//VTK::Light::Impl";
  shaders->AddVertexShaderReplacement(
      declarations, true,
      after(declarations, "in vec2 " + name + ";\nout vec2 " + name + "Fragment;"), false);
  shaders->AddVertexShaderReplacement(positions, true,
                                      after(positions, name + "Fragment = " + name + ";"), false);
  shaders->AddFragmentShaderReplacement(inputs, true,
                                        after(inputs, "in vec2 " + name + "Fragment;"), false);
  shaders->AddFragmentShaderReplacement(
      output, true,
      after(output, "gl_FragData[0].a *= clamp(" + name + "Fragment.y - abs(" + name +
                        "Fragment.x), 0.0, 1.0);"),
      false);
}

}  // namespace

SmoothDrawing::SmoothDrawing(double height) : height_(height) {
  colors_->SetNumberOfComponents(4);
  aside_->SetNumberOfComponents(2);
  aside_->SetName(kAside);
}

void SmoothDrawing::add_line(std::span<const Vector2d> points, double width, const Ink& ink) {
  const double outside = std::max(width / 2, kFade) + kFade;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d aside = outside * mitre(points, i);
    const vtkIdType left = add_point(points[i] - aside, ink, -outside, outside),
                    right = add_point(points[i] + aside, ink, outside, outside);
    if (i > 0) add_quad(left - 2, right - 2, right, left);
  }
}

void SmoothDrawing::add_disc(const Vector2d& center, double radius, const Ink& ink) {
  constexpr int kCorners = 20;
  const double outside = std::max(radius, kFade) + kFade;
  const vtkIdType middle = add_point(center, ink, 0, outside);
  std::array<vtkIdType, kCorners> rim;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCorners;
    rim[k] = add_point(center + outside * Vector2d(std::cos(angle), std::sin(angle)), ink, outside,
                       outside);
  }
  for (int k = 0; k < kCorners; ++k) {
    const vtkIdType triangle[3] = {middle, rim[k], rim[(k + 1) % kCorners]};
    polygons_->InsertNextCell(3, triangle);
  }
}

vtkSmartPointer<vtkActor> SmoothDrawing::finish() {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_);
  data->SetPolys(polygons_);
  data->GetPointData()->SetScalars(colors_);
  data->GetPointData()->AddArray(aside_);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->MapDataArrayToVertexAttribute(kAside, kAside, vtkDataObject::FIELD_ASSOCIATION_POINTS,
                                        -1);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  // VTK blends opaque actors, too, one over the other, but translucent ones in no order.
  actor->ForceOpaqueOn();
  fade_edges(actor->GetShaderProperty());
  return actor;
}

vtkIdType SmoothDrawing::add_point(const Vector2d& p, const Ink& ink, double aside,
                                   double outside) {
  for (const int c : ink) colors_->InsertNextValue(static_cast<unsigned char>(c));
  colors_->InsertNextValue(255);
  aside_->InsertNextTuple2(aside, outside);
  return points_->InsertNextPoint(p.x(), height_ - p.y(), 0);
}

void SmoothDrawing::add_quad(vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d) {
  const vtkIdType corners[4] = {a, b, c, d};
  polygons_->InsertNextCell(4, corners);
}

}  // namespace quadrille::viewer
