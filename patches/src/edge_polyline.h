#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// A point in fixed point: kFixedOne units to a sample.
struct FixedPoint {
  std::int64_t x, y;
};
constexpr int kFixedBits = 16;
constexpr std::int64_t kFixedOne = std::int64_t{1} << kFixedBits;

/// Index of the first sample whose centre is not left of (not above) a coordinate with `bits` bits
/// to a sample: ceil(coordinate / 2^bits - 1/2).
inline std::int64_t first_center(std::int64_t coordinate, int bits) {
  const std::int64_t half = std::int64_t{1} << (bits - 1);
  return (coordinate + half - 1) >> bits;
}

/// Into how many pieces edge e is cut at dyadic parameters so that chords deviate by at most 1/128
/// sample: a power of two, at most 2^14, and 1 for a straight edge. `to_samples` takes the mesh's
/// coordinates to samples.
int edge_piece_count(const PatchMesh& patches, int e, const Eigen::Affine2d& to_samples);

/// The pieces' ends, one more than pieces, from the origin to the tip of the edge's half-edge. They
/// depend on nothing but the edge and the map. Throws Error{invalid_argument} for coordinates that
/// are not finite and Error{limit_exceeded} for |coordinates| >= 2^31 samples.
void write_edge_polyline(const PatchMesh& patches, int e, const Eigen::Affine2d& to_samples,
                         std::span<FixedPoint> points);

}  // namespace quadrille
