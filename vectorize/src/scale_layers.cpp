#include <algorithm>
#include <array>
#include <cmath>

#include "field_layers.h"
#include "scene_parts.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

/// From short (dark violet) over teal to long (yellow): even steps of lightness.
Ink length_ink(double t) {
  constexpr std::array<Ink, 5> kStops = {
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = std::clamp(t, 0.0, 1.0) * (kStops.size() - 1);
  const int low = std::min<int>(static_cast<int>(at), kStops.size() - 2);
  Ink ink;
  for (int c = 0; c < 3; ++c) {
    ink[c] = static_cast<int>(kStops[low][c] + (at - low) * (kStops[low + 1][c] - kStops[low][c]));
  }
  return ink;
}

/// The lattice's edges at a working pixel, source pixels.
struct Edges {
  Vector2d u, v;
};
Edges edges_at(const Quadrangulation& stages, int i, int j) {
  const double angle = stages.cross.angle(i, j);
  const Vector2d axis(std::cos(angle), std::sin(angle)), normal(-axis.y(), axis.x());
  const Vector2d u = axis * stages.scale.along_x(i, j), v = normal * stages.scale.along_y(i, j);
  return {to_source(stages.working, u.x(), u.y()), to_source(stages.working, v.x(), v.y())};
}

std::vector<std::uint8_t> length_tint(const std::vector<float>& lengths) {
  constexpr double kStrength = 0.7;
  const auto [shortest, longest] = std::ranges::minmax_element(lengths);
  const double low = std::log(*shortest), range = std::log(*longest) - low;
  std::vector<std::uint8_t> tint;
  for (const float length : lengths) {
    add_bytes(tint, length_ink(range > 0 ? (std::log(length) - low) / range : 0.5));
    tint.push_back(static_cast<std::uint8_t>(std::lround(255 * kStrength)));
  }
  return tint;
}

SceneLayer length_layer(const Quadrangulation& stages) {
  SceneGrid grid = grid_of(stages.scale.along_x, stages.working);
  std::vector<float> length_u, length_v, length;
  for (int j = 0; j < grid.height; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      const auto [u, v] = edges_at(stages, i, j);
      length_u.push_back(static_cast<float>(u.norm()));
      length_v.push_back(static_cast<float>(v.norm()));
      length.push_back(std::sqrt(length_u.back() * length_v.back()));
    }
  }
  std::vector<std::uint8_t> tint = length_tint(length);
  grid.arrays = {
      number_array("length_u", "edge length along the first axis of the cross, source pixels",
                   std::move(length_u)),
      number_array("length_v", "edge length along the second axis of the cross, source pixels",
                   std::move(length_v)),
      number_array("length", "geometric mean of both lengths, source pixels", std::move(length)),
      color_array("rgba", "tint from violet (short) to yellow (long)", 4, std::move(tint))};
  SceneLayer layer{"edge-length", "edge length from violet (short) to yellow (long)"};
  layer.style.colors = "rgba";
  layer.content = std::move(grid);
  return layer;
}

/// Crosses with the lengths and directions of the lattice's edges, with room between them.
SceneLayer edge_cross_layer(const Quadrangulation& stages, double drawing_pixel) {
  constexpr double kSpacing = 64, kLongestArm = 28;  // pixels of the drawing
  const ScaleField& scale = stages.scale;
  const double longest =
      std::max(std::ranges::max(scale.along_x.data), std::ranges::max(scale.along_y.data));
  const double step_x = std::max(1.0, kSpacing * drawing_pixel / stages.working.scale_x);
  const double step_y = std::max(1.0, kSpacing * drawing_pixel / stages.working.scale_y);
  SceneShapes shapes;
  VectorArray axis_u, axis_v;
  for (double y = step_y / 2; y < scale.along_x.height; y += step_y) {
    for (double x = step_x / 2; x < scale.along_x.width; x += step_x) {
      const int i = static_cast<int>(x), j = static_cast<int>(y);
      const auto [u, v] = edges_at(stages, i, j);
      shapes.points.push_back(to_source(stages.working, i + 0.5, j + 0.5));
      axis_u.add(u);
      axis_v.add(v);
    }
  }
  shapes.point_arrays = {
      axis_u.finish("axis_u", "the lattice's edge along the first axis, source pixels"),
      axis_v.finish("axis_v", "the lattice's edge along the second axis, source pixels")};
  SceneLayer layer{"edge-crosses", "directions and proportions of the lattice's edges"};
  layer.style.marker = Marker::cross;
  layer.style.width = 2;
  layer.style.arm_length =
      std::min(0.5, kLongestArm * drawing_pixel / (longest * stages.working.scale_x));
  layer.content = std::move(shapes);
  return layer;
}

}  // namespace

std::vector<SceneLayer> scale_layers(const Quadrangulation& stages, double drawing_pixel) {
  return {length_layer(stages), edge_cross_layer(stages, drawing_pixel)};
}

}  // namespace quadrille
