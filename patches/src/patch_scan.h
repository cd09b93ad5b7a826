#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// A grid of sample points over a patch mesh: the mesh point p lies at p * scale + offset in sample
/// units, and sample (i, j) has its centre at (i + 0.5, j + 0.5) there.
struct SampleGrid {
  Eigen::Array2d scale = {1, 1};
  Eigen::Array2d offset = {0, 0};
};

/// Half-open range of samples.
struct SampleWindow {
  int x_begin = 0, y_begin = 0, x_end = 0, y_end = 0;
  bool empty() const { return x_begin >= x_end || y_begin >= y_end; }
};

/// Scan conversion of patch outlines with an exact coverage rule. Each mesh edge is evaluated once,
/// at dyadic parameters, and put on a global fixed-point grid; the two patches beside it use the
/// same integers, so every sample inside a fold-free mesh belongs to exactly one patch whatever the
/// window.
class PatchScan {
 public:
  /// Evaluates the edges of the patches; grid must give |coordinates| < 2^31 samples.
  PatchScan(const PatchMesh& patches, const SampleGrid& grid);

  /// Smallest window of samples that the patch's outline may cover (not clipped to anything).
  SampleWindow bounds(int patch) const;

  /// Calls row(y, x_begin, x_end) for the samples of the window that the patch covers (winding
  /// number of its outline > 0), rows in ascending order and ranges of a row from left to right.
  void scan(int patch, const SampleWindow& window,
            const std::function<void(int y, int x_begin, int x_end)>& row) const;

 private:
  struct Point {
    std::int64_t x, y;
  };
  std::vector<int> polyline_begin_;  // #E + 1
  std::vector<Point> points_;        // fixed-point samples of all edges
  const PatchMesh& patches_;
};

/// Inverse of a patch's geometry: finds the parameters of a point of the plane. Prepared once per
/// patch; each call depends on nothing but the patch and the point.
class PatchInverse {
 public:
  explicit PatchInverse(const BicubicHermite<Eigen::Vector2d>& geometry);

  /// Parameters in [0,1]^2 whose position is p, clamped to the square for points slightly outside
  /// (the outline is scanned as a polyline). For a fold-free patch the residual is below 1e-6 of
  /// the patch's size wherever p lies inside.
  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const;

 private:
  BicubicHermite<Eigen::Vector2d> geometry_;
};

}  // namespace quadrille
