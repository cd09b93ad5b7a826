#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace quadrille {

/// A straight piece of a numbered curve that starts at arc length s.
struct CurveSegment {
  int curve;
  Eigen::Vector2d a, b;
  double s;
};

/// Finds the place on any of some curves that is nearest to a point.
class CurveIndex {
 public:
  struct Place {
    int curve;
    double s;
    double distance;
  };

  /// `cell` is about the distance within which places are looked for.
  CurveIndex(std::vector<CurveSegment> segments, double cell);
  std::optional<Place> nearest(const Eigen::Vector2d& p, double reach) const;

 private:
  std::vector<CurveSegment> segments_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  double cell_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<int>> cells_;
};

}  // namespace quadrille
