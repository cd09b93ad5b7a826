#pragma once

#include <Eigen/Core>
#include <cmath>

namespace quadrille {

/// Nearest whole number, for |a| < 2^22: adding 1.5 * 2^23 leaves no room for a fraction. Several
/// times faster than a call of std::round where the processor has no instruction for it.
inline float round_to_whole(float a) {
  constexpr float kNoFraction = 12582912.0f;
  return (a + kNoFraction) - kNoFraction;
}

/// The local lattice directions at a point: two perpendicular edge vectors and the map back to
/// lattice units.
struct LatticeFrame {
  Eigen::Vector2f x, y;                  ///< edge vectors, working pixels
  Eigen::Vector2f inverse_x, inverse_y;  ///< rows of the inverse

  LatticeFrame(float angle, float length_x, float length_y)
      : LatticeFrame(Eigen::Vector2f(std::cos(angle), std::sin(angle)), length_x, length_y) {}
  LatticeFrame(const Eigen::Vector2f& direction, float length_x, float length_y) {
    const Eigen::Vector2f normal(-direction.y(), direction.x());
    x = direction * length_x;
    y = normal * length_y;
    inverse_x = direction / length_x;
    inverse_y = normal / length_y;
  }

  Eigen::Vector2f to_lattice(const Eigen::Vector2f& d) const {
    return {inverse_x.dot(d), inverse_y.dot(d)};
  }
  Eigen::Vector2f from_lattice(const Eigen::Vector2f& n) const { return x * n.x() + y * n.y(); }

  /// The point of the lattice through `origin` that is nearest to p (intrinsic rounding).
  Eigen::Vector2f nearest(const Eigen::Vector2f& origin, const Eigen::Vector2f& p) const {
    const Eigen::Vector2f n = to_lattice(p - origin);
    return origin + from_lattice({round_to_whole(n.x()), round_to_whole(n.y())});
  }
};

}  // namespace quadrille
