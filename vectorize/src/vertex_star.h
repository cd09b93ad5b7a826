#pragma once

#include <Eigen/Core>
#include <span>

namespace quadrille {

/// How a vertex may move: freely, along a line, or not at all. A stricter guide is a later kind.
struct VertexGuide {
  enum class Kind { free, line, fixed };
  Kind kind = Kind::free;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();       ///< a point of the line
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< its direction, of length 1

  static VertexGuide free() { return {}; }
  static VertexGuide on_line(const Eigen::Vector2d& point, const Eigen::Vector2d& direction) {
    return {Kind::line, point, direction};
  }
  static VertexGuide at(const Eigen::Vector2d& point) {
    return {Kind::fixed, point, Eigen::Vector2d::UnitX()};
  }
  bool is_same_line(const VertexGuide& other) const;
};

/// The corners of one face that a vertex takes part in: its own, and those of the vertices before
/// and after it in the face, whose far neighbours are `before2` and `after2` (the same in a quad).
struct StarWedge {
  Eigen::Vector2d before2, before, after, after2;
};

/// The faces around a vertex; only the vertex itself moves.
class VertexStar {
 public:
  explicit VertexStar(std::span<const StarWedge> wedges) : wedges_(wedges) {}

  /// The smallest sine of the corner angles with the vertex at p; negative when one is reflex.
  double smallest_sine(const Eigen::Vector2d& p) const;

  /// A position with a lower shape energy than p has, by at most three damped Newton steps with
  /// line search along the guide; p itself when there is none. The energy sums 1 / sin^2 over the
  /// corners, which tends to infinity where a corner degenerates and does not depend on lengths, so
  /// that anisotropic cells are as good as squares, and hold |p - anchor|^2 over the mean squared
  /// edge at the vertex. Where a corner at p is not positive, the determinant D in the sines is
  /// replaced by (D + sqrt(D^2 + d^2)) / 2, which leads out of the fold (Escobar et al.,
  /// Simultaneous untangling and smoothing of tetrahedral meshes, 2003).
  Eigen::Vector2d improved(const Eigen::Vector2d& p, const VertexGuide& guide,
                           const Eigen::Vector2d& anchor, double hold) const;

 private:
  std::span<const StarWedge> wedges_;
};

}  // namespace quadrille
