#include <algorithm>
#include <cmath>
#include <numbers>

#include "field_layers.h"
#include "scene_parts.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

SceneLayer singularity_layer(const std::vector<Singularity>& list, const WorkingPicture& working) {
  SceneShapes shapes;
  std::vector<std::int32_t> index;
  std::vector<std::uint8_t> ink;
  for (const Singularity& s : list) {
    shapes.points.push_back(to_source(working, s.x, s.y));
    index.push_back(s.quarter_index);
    add_bytes(ink, s.quarter_index > 0 ? kRed : kBlue);
  }
  shapes.point_arrays = {
      number_array("quarter_index", "four times the index of the singularity", std::move(index)),
      color_array("rgb", "red for positive, blue for negative indices", 3, std::move(ink))};
  SceneLayer layer{"singularities", "singularities of index +1/4 red and -1/4 blue"};
  layer.style.marker = Marker::mark;
  layer.style.colors = "rgb";
  layer.content = std::move(shapes);
  return layer;
}

/// Those that the field had before cancelling and has no more, nor close by: moved ones stay out.
std::vector<Singularity> cancelled(const CrossField& cross) {
  constexpr double kMoved = 8;  // working pixels
  const auto before = std::ranges::find(cross.phases, "renormalised", &CrossFieldPhase::name);
  if (before == cross.phases.end()) return {};
  const std::vector<Singularity> left = singularities(cross);
  std::vector<Singularity> gone;
  std::ranges::copy_if(before->singularities, std::back_inserter(gone), [&](const Singularity& s) {
    return std::ranges::none_of(left, [&](const Singularity& other) {
      return other.quarter_index == s.quarter_index &&
             std::hypot(other.x - s.x, other.y - s.y) <= kMoved;
    });
  });
  return gone;
}

SceneLayer cancelled_layer(const Quadrangulation& stages) {
  SceneLayer layer = singularity_layer(cancelled(stages.cross), stages.working);
  layer.name = "cancelled-singularities";
  layer.summary = "where singularities were cancelled";
  layer.style.marker = Marker::ring;
  return layer;
}

/// Working pixels between two crosses: whole, so that no row or column is wider than others.
double whole_step(double wished) { return std::max(1.0, std::round(wished)); }

SceneLayer cross_layer(const Quadrangulation& stages, double drawing_pixel) {
  constexpr double kSpacing = 20, kArm = 8;  // pixels of the drawing
  const CrossField& cross = stages.cross;
  const double step_x = whole_step(kSpacing * drawing_pixel / stages.working.scale_x);
  const double step_y = whole_step(kSpacing * drawing_pixel / stages.working.scale_y);
  SceneShapes shapes;
  VectorArray axis_u, axis_v;
  std::vector<float> weight;
  for (double y = step_y / 2; y < cross.z.height; y += step_y) {
    for (double x = step_x / 2; x < cross.z.width; x += step_x) {
      const int i = static_cast<int>(x), j = static_cast<int>(y);
      const double angle = cross.angle(i, j);
      const Vector2d axis(std::cos(angle), std::sin(angle));
      shapes.points.push_back(to_source(stages.working, i + 0.5, j + 0.5));
      axis_u.add(axis);
      axis_v.add({-axis.y(), axis.x()});
      weight.push_back(stages.features.weight(i, j));
    }
  }
  shapes.point_arrays = {axis_u.finish("axis_u", "unit vector along one axis of the cross"),
                         axis_v.finish("axis_v", "unit vector along the other axis"),
                         number_array("weight", "feature weight there, 0 to 1", std::move(weight))};
  SceneLayer layer{"cross-field", "crosses along the field's axes"};
  layer.style.marker = Marker::cross;
  layer.style.arm_length = kArm * drawing_pixel;
  layer.content = std::move(shapes);
  return layer;
}

}  // namespace

std::vector<SceneLayer> cross_field_layers(const Quadrangulation& stages, double drawing_pixel) {
  return {cross_layer(stages, drawing_pixel), cancelled_layer(stages),
          singularity_layer(singularities(stages.cross), stages.working)};
}

std::vector<SceneLayer> position_layers(const Quadrangulation& stages, double) {
  const auto& origin = stages.position.origin;
  SceneShapes shapes;
  VectorArray offset;
  for (int j = 0; j < origin.height; ++j) {
    for (int i = 0; i < origin.width; ++i) {
      const Vector2d p = to_source(stages.working, origin(i, j).x(), origin(i, j).y());
      shapes.points.push_back(p);
      offset.add(to_source(stages.working, i + 0.5, j + 0.5) - p);
    }
  }
  shapes.point_arrays = {
      offset.finish("offset", "from the lattice point to its working pixel, source pixels")};
  SceneLayer layer{"lattice-points", "the lattice point of every working pixel"};
  layer.content = std::move(shapes);
  return {std::move(layer), singularity_layer(singularities(stages.cross), stages.working)};
}

}  // namespace quadrille
