#include "draw_layer.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

namespace quadrille::cli {
namespace {

using Eigen::Vector2d;

/// The inks of a layer's elements, from its colour array or else its style.
class Inks {
 public:
  Inks(const SceneStyle& style, const std::vector<SceneArray>& arrays) : ink_(style.ink) {
    if (style.colors.empty()) return;
    const auto array = std::ranges::find(arrays, style.colors, &SceneArray::name);
    if (array == arrays.end()) return;
    bytes_ = std::get<std::vector<std::uint8_t>>(array->values);
    components_ = array->components;
  }

  Ink ink(std::size_t element) const {
    if (bytes_.empty()) return ink_;
    const std::uint8_t* c = &bytes_[components_ * element];
    return {c[0], c[1], c[2]};
  }
  double strength(std::size_t element) const {
    return components_ == 4 ? bytes_[4 * element + 3] / 255.0 : 1.0;
  }

 private:
  Ink ink_;
  std::span<const std::uint8_t> bytes_;
  int components_ = 0;
};

Vector2d vector_at(const SceneShapes& shapes, const char* name, std::size_t point) {
  const auto array = std::ranges::find(shapes.point_arrays, name, &SceneArray::name);
  const auto& values = std::get<std::vector<float>>(array->values);
  return {values[2 * point], values[2 * point + 1]};
}

void draw_cross(Canvas& canvas, const SceneShapes& shapes, std::size_t point,
                const SceneStyle& style, const Ink& ink) {
  for (const char* name : {"axis_u", "axis_v"}) {
    const Vector2d arm = style.arm_length * vector_at(shapes, name, point);
    canvas.line(shapes.points[point] - arm, shapes.points[point] + arm, ink,
                static_cast<int>(style.width));
  }
}

void draw_points(Canvas& canvas, const SceneShapes& shapes, const SceneStyle& style) {
  const Inks inks(style, shapes.point_arrays);
  for (std::size_t i = 0; i < shapes.points.size(); ++i) {
    const Vector2d& p = shapes.points[i];
    switch (style.marker) {
      case Marker::dot:
        canvas.dot(p, style.radius, inks.ink(i));
        break;
      case Marker::mark:
        canvas.mark(p, inks.ink(i));
        break;
      case Marker::ring:
        canvas.ring(p, inks.ink(i));
        break;
      case Marker::cross:
        draw_cross(canvas, shapes, i, style, inks.ink(i));
        break;
    }
  }
}

std::span<const int> points_of(const SceneShapes& shapes, int cell) {
  const int begin = shapes.cell_begin[cell];
  return std::span(shapes.cell_points).subspan(begin, shapes.cell_begin[cell + 1] - begin);
}

void draw_lines(Canvas& canvas, const SceneShapes& shapes, const SceneStyle& style) {
  const Inks inks(style, shapes.cell_arrays);
  std::vector<Vector2d> curve;
  for (int c = 0; c < shapes.cell_count(); ++c) {
    curve.clear();
    for (const int p : points_of(shapes, c)) curve.push_back(shapes.points[p]);
    canvas.curve(curve, inks.ink(c), static_cast<int>(style.width));
  }
}

/// Sides that polygons share are drawn once, or they would be darker than those of the border.
void draw_outlines(Canvas& canvas, const SceneShapes& shapes, const SceneStyle& style) {
  std::set<std::pair<int, int>> drawn;
  for (int c = 0; c < shapes.cell_count(); ++c) {
    const std::span<const int> corners = points_of(shapes, c);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int a = corners[k], b = corners[(k + 1) % corners.size()];
      if (!drawn.emplace(std::minmax(a, b)).second) continue;
      canvas.line(shapes.points[a], shapes.points[b], style.ink, static_cast<int>(style.width));
    }
  }
}

void draw_grid(Canvas& canvas, const SceneGrid& grid, const SceneStyle& style) {
  const Inks inks(style, grid.arrays);
  canvas.tint([&](double x, double y) -> Canvas::Tint {
    const int i = std::clamp(static_cast<int>(x / grid.pixel_width), 0, grid.width - 1);
    const int j = std::clamp(static_cast<int>(y / grid.pixel_height), 0, grid.height - 1);
    const std::size_t pixel = static_cast<std::size_t>(j) * grid.width + i;
    return {inks.ink(pixel), inks.strength(pixel)};
  });
}

}  // namespace

void draw_layer(Canvas& canvas, const SceneLayer& layer) {
  if (const auto* grid = std::get_if<SceneGrid>(&layer.content)) {
    draw_grid(canvas, *grid, layer.style);
  } else if (const auto* shapes = std::get_if<SceneShapes>(&layer.content)) {
    switch (shapes->cell) {
      case SceneShapes::Cell::point:
        draw_points(canvas, *shapes, layer.style);
        break;
      case SceneShapes::Cell::line:
        draw_lines(canvas, *shapes, layer.style);
        break;
      case SceneShapes::Cell::polygon:
        draw_outlines(canvas, *shapes, layer.style);
        break;
    }
  }
}

}  // namespace quadrille::cli
