#include "shape_actor.h"

#include <algorithm>
#include <span>

#include "clip_shapes.h"
#include "smooth_drawing.h"

namespace quadrille::viewer {
namespace {

using Eigen::Vector2d;

constexpr Ink kWhite = {255, 255, 255};
constexpr double kRimRadius = 5, kMarkRadius = 3.5;  // of a mark, window pixels

/// The inks of a layer's elements, from its array of colours or else its style.
class Inks {
 public:
  Inks(const SceneStyle& style, const std::vector<SceneArray>& arrays) : ink_(style.ink) {
    const auto array = std::ranges::find(arrays, style.colors, &SceneArray::name);
    if (style.colors.empty() || array == arrays.end()) return;
    bytes_ = std::get<std::vector<std::uint8_t>>(array->values);
    components_ = array->components;
  }
  Ink operator[](std::size_t element) const {
    if (bytes_.empty()) return ink_;
    const std::uint8_t* c = &bytes_[components_ * element];
    return {c[0], c[1], c[2]};
  }

 private:
  Ink ink_;
  std::span<const std::uint8_t> bytes_;
  int components_ = 0;
};

Vector2d vector_at(const SceneShapes& shapes, const char* name, int point) {
  const auto array = std::ranges::find(shapes.point_arrays, name, &SceneArray::name);
  const auto& values = std::get<std::vector<float>>(array->values);
  return {values[2 * point], values[2 * point + 1]};
}

void add_marker(SmoothDrawing& drawing, const SceneShapes& shapes, const SceneStyle& style,
                const Frame& frame, int point, const Vector2d& place, const Ink& ink) {
  switch (style.marker) {
    case Marker::dot:
      drawing.add_disc(place, style.radius, ink);
      break;
    case Marker::mark:
      drawing.add_disc(place, kRimRadius, kWhite);
      drawing.add_disc(place, kMarkRadius, ink);
      break;
    case Marker::ring:
      drawing.add_disc(place, kRimRadius, kWhite);
      drawing.add_disc(place, kMarkRadius + 0.5, ink);
      drawing.add_disc(place, kMarkRadius - 0.5, kWhite);
      break;
    case Marker::cross:
      for (const char* name : {"axis_u", "axis_v"}) {
        const Vector2d arm =
            style.arm_length * (vector_at(shapes, name, point).array() * frame.scale).matrix();
        drawing.add_line(std::array{Vector2d(place - arm), Vector2d(place + arm)}, style.width,
                         ink);
      }
      break;
  }
}

}  // namespace

vtkSmartPointer<vtkActor> make_shape_actor(const SceneShapes& shapes, const SceneStyle& style,
                                           const Frame& frame, int margin) {
  const Vector2d around = Vector2d::Constant(margin);
  const Eigen::AlignedBox2d box(-around, frame.window.cast<double>().matrix() + around);
  const WindowShapes clipped = clip_shapes(shapes, frame.scale, frame.origin.cast<double>(), box);
  SmoothDrawing drawing(frame.window.y());
  const Inks cell_inks(style, shapes.cell_arrays), point_inks(style, shapes.point_arrays);
  for (const WindowShapes::Line& line : clipped.lines) {
    drawing.add_line(line.points, style.width, cell_inks[line.cell]);
  }
  for (const auto& [point, place] : clipped.points) {
    add_marker(drawing, shapes, style, frame, point, place, point_inks[point]);
  }
  return drawing.finish();
}

}  // namespace quadrille::viewer
