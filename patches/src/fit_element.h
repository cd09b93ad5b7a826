#pragma once

#include <Eigen/Core>
#include <array>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// The unknowns of one wedge: columns value, dx, dy, twist; rows red, green, blue, alpha.
using WedgeUnknowns = Eigen::Matrix4f;
using CornerUnknowns = std::array<WedgeUnknowns, 4>;

/// How the unknowns of a wedge enter the Hermite form of one patch corner; see ferguson_patch().
struct CornerMap {
  Eigen::Vector2f du, dv, duv;  ///< derivatives of the position
  float twist;                  ///< factor of the wedge's twist
};

std::array<CornerMap, 4> corner_maps(const PatchMesh& patches, int q);

/// Bezier form of the patch's colour for the given unknowns.
BicubicBezier<Color> colors_of(const std::array<CornerMap, 4>& corners, const CornerUnknowns& x);

/// The transpose of colors_of: derivatives by the unknowns from derivatives by the control colours.
CornerUnknowns transpose_of(const std::array<CornerMap, 4>& corners,
                            const BicubicBezier<Color>& gradient);

/// The factors by which the unknowns at the four corners enter the patch's colour at uv.
std::array<Eigen::Vector4f, 4> corner_factors(const std::array<CornerMap, 4>& corners,
                                              const Eigen::Vector2d& uv);

/// The moments of samples spread evenly over the parameter square, which weigh `weight` together.
///
/// In Bernstein form the product of two cubic basis functions is one sextic one, up to a factor, so
/// the 16 x 16 matrix of a bicubic patch in the normal equations of the least-squares fit has only
/// 7 x 7 different entries: the moments sum over samples of u^p (1-u)^(6-p) v^q (1-v)^(6-q), kept
/// at 7 q + p.
std::array<double, 49> uniform_moments(double weight);

}  // namespace quadrille
