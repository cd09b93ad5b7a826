#pragma once

#include <vector>

#include "quadrille/planar_loops.h"

namespace quadrille {

/// Tells many points inside an outline from those outside: the sides are sorted into horizontal
/// strips, and a point counts those of its own strip only.
class InsideTest {
 public:
  explicit InsideTest(const std::vector<Loop>& outline);
  bool operator()(const Eigen::Vector2d& p) const;

 private:
  struct Side {
    Eigen::Vector2d upper, lower;
  };
  double top_ = 0, strip_height_ = 1;
  std::vector<std::vector<Side>> strips_;
};

}  // namespace quadrille
