#pragma once

#include <string>
#include <utility>
#include <vector>

#include "quadrille/patch_mesh.h"
#include "quadrille/scene_layer.h"

namespace quadrille {

/// Collects the values of an array.
template <class T>
SceneArray scene_array(std::string name, std::string meaning, std::vector<T> values,
                       int components = 1, SceneArray::Kind kind = SceneArray::Kind::number) {
  return {std::move(name), std::move(meaning), components, kind, std::move(values)};
}

/// The point at t in [0, 1] of the curve of edge e, along mesh.halfedge(e); both patches beside it
/// have this curve.
Eigen::Vector2d edge_point(const PatchMesh& patches, int e, double t);

}  // namespace quadrille
