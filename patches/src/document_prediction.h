#pragma once

#include <array>
#include <vector>

#include "document_quantization.h"
#include "wedge_corners.h"

namespace quadrille {

/// What a colour number of a wedge is predicted from: base + sum of weight * term.
struct Prediction {
  static constexpr int kTerms = 3;
  double base = 0;
  std::array<double, kTerms> terms{};
};

/// Predicts the numbers of one channel of wedges from those known so far. All numbers are in the
/// units of LocalColors: differences of colour along an edge.
class ChannelPredictor {
 public:
  /// `patches` has its tangents and straight_patches()' wedge numbers.
  ChannelPredictor(const PatchMesh& patches, const std::vector<ColorFrame>& frames);

  /// Forgets all numbers.
  void clear();
  /// Tells a number that is now known.
  void learn(int wedge, WedgeKind kind, double number);

  /// From the kinds before, of all wedges, and from the same kind of the wedges before.
  Prediction predict(int wedge, WedgeKind kind) const;

 private:
  const PatchMesh& patches_;
  const std::vector<ColorFrame>& frames_;
  WedgeCorners corners_;
  std::vector<BicubicHermite<Eigen::Vector2d>> geometry_;  // per patch
  std::vector<Eigen::Matrix2d> slope_of_;  // inverse normal matrix of the gradient's fit
  std::vector<std::array<double, 4>> known_;
  std::vector<Eigen::Vector2d> gradients_;  // per pixel

  Prediction predict_value(int wedge) const;
  Prediction predict_gradient(int wedge, int axis) const;
  Prediction predict_twist(int wedge) const;
  int wedge_at(int h) const { return patches_.wedge_of_corner[h]; }
  int vertex_of(int wedge) const { return patches_.mesh.origin(corners_[wedge].front()); }
};

}  // namespace quadrille
