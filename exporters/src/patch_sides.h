#pragma once

#include <Eigen/Core>

#include "quadrille/bicubic.h"

namespace quadrille {

/// Parameters of the point at `s` along side k of a patch, from corner k to corner k + 1, `depth`
/// inside of it.
Eigen::Vector2d on_side(int k, double s, double depth = 0);

/// How far the parameter may run from uv, across lines of constant u (or v), to cover `distance`
/// pixels: at most half of the patch's width, beyond which may lie something else, and at most
/// three distances where the sides of the patch meet at a small angle.
double parameter_step(const BicubicHermite<Eigen::Vector2d>& g, const Eigen::Vector2d& uv,
                      bool along_u, double distance);

/// The point `distance` pixels inside side k at `s`, as far as parameter_step() goes.
Eigen::Vector2d inside(const BicubicHermite<Eigen::Vector2d>& g, int k, double s, double distance);

}  // namespace quadrille
