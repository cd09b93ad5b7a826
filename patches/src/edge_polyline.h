#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// A point in fixed point: kFixedOne units to a sample.
struct FixedPoint {
  std::int64_t x, y;
};
constexpr int kFixedBits = 16;
constexpr std::int64_t kFixedOne = std::int64_t{1} << kFixedBits;

/// Appends edge e as a polyline from the origin to the tip of its half-edge: the ends and the
/// curve's points at dyadic parameters, close enough that chords deviate by at most 1/128 sample,
/// at most 2^14 of them. A straight edge has two points. `to_samples` takes the mesh's coordinates
/// to samples. The result depends on nothing but the edge and the map. Throws
/// Error{invalid_argument} for coordinates that are not finite and Error{limit_exceeded} for
/// |coordinates| >= 2^31 samples.
void append_edge_polyline(const PatchMesh& patches, int e, const Eigen::Affine2d& to_samples,
                          std::vector<FixedPoint>& points);

}  // namespace quadrille
