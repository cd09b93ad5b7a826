#pragma once

#include <Eigen/Core>
#include <vector>

namespace quadrille {

/// The arc length at each point of a polyline, from 0 at the first one.
std::vector<double> arc_lengths(const std::vector<Eigen::Vector2d>& points);

/// A curve between two nodes of a chain network, by arc length.
class ChainCurve {
 public:
  /// The points must outlive the curve.
  explicit ChainCurve(const std::vector<Eigen::Vector2d>& points);
  double length() const { return arc_.back(); }
  Eigen::Vector2d at(double s) const;
  /// Unit direction of the chord between two places.
  Eigen::Vector2d direction(double from, double to) const;

 private:
  const std::vector<Eigen::Vector2d>& points_;
  std::vector<double> arc_;  // of each point
};

}  // namespace quadrille
