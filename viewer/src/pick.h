#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/scene_layer.h"
#include "quadrille/scene_window.h"

namespace quadrille::viewer {

/// A vertex or a patch of a picture.
struct Pick {
  enum class Kind { vertex, patch };
  Kind kind = Kind::patch;
  int layer = 0;
  int index = 0;        ///< of the vertex or patch in its layer
  double u = 0, v = 0;  ///< where in a patch
  bool operator==(const Pick&) const = default;
};

/// The vertex nearest to a point of the picture if one is within `reach` pixels of the source, or
/// else the patch there: of the layer drawn last, and where a layer overlaps itself the lowest.
std::optional<Pick> pick(const VectorImage& image, const Eigen::Vector2d& point, double reach);

/// The parameters of a patch at a point, found by halving its Bezier form and Newton's method.
std::optional<Eigen::Vector2d> parameters_at(const BicubicHermite<Eigen::Vector2d>& patch,
                                             const Eigen::Vector2d& point);

/// The numbers of what was picked, a few lines. `errors` as in ScenePatches.
std::string describe(const VectorImage& image, const Pick& pick, const std::vector<float>& errors);

/// The patch's outline, or a ring around the vertex.
SceneLayer picked_layer(const VectorImage& image, const Pick& pick, const SceneWindow& window);

}  // namespace quadrille::viewer
