#include "subdivision.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace quadrille {
namespace {

constexpr int kLines = 5;    // curves of constant parameter that are looked at per direction
constexpr int kPerPart = 4;  // samples within a part of such a curve

Color clamped(const Color& color) { return color.cwiseMax(0.0f).cwiseMin(1.0f); }

/// How far the colours along curves lie from the polylines through the ends of their parts.
struct Deviation {
  double largest = 0;       ///< over samples and channels
  double mean_squared = 0;  ///< likewise
};

Deviation polyline_deviation(const std::array<Color, 4>& curve, int parts) {
  const BicubicBezier<Color> strip{{curve, curve, curve, curve}};
  Deviation deviation;
  Color left = clamped(curve[0]);
  for (int i = 0; i < parts; ++i) {
    const Color right = clamped(strip.at(double(i + 1) / parts, 0));
    for (int k = 1; k < kPerPart; ++k) {
      const double f = double(k) / kPerPart;
      const Color truth = clamped(strip.at((i + f) / parts, 0));
      const Color difference = truth - (left * float(1 - f) + right * float(f));
      deviation.largest = std::max(deviation.largest, double(difference.abs().maxCoeff()));
      // Alpha counts with the three colours, whose mean is meant.
      deviation.mean_squared += difference.square().sum() / 3 / (kPerPart * parts);
    }
    left = right;
  }
  return deviation;
}

constexpr int kCounts[] = {1, 2, 3, 4};
constexpr int kCountCount = static_cast<int>(std::size(kCounts));
using Deviations = std::array<Deviation, kCountCount>;

/// The deviation along u (or v) for each number of parts in kCounts.
Deviations deviations_along(const BicubicBezier<Color>& color, bool along_u) {
  Deviations all;
  for (int l = 0; l < kLines; ++l) {
    const double t = double(l) / (kLines - 1);
    std::array<Color, 4> curve;
    for (int i = 0; i < 4; ++i) {
      std::array<Color, 4> across;
      for (int j = 0; j < 4; ++j) across[j] = along_u ? color.control[j][i] : color.control[i][j];
      curve[i] = sub_curve(across, t, t)[0];
    }
    for (int n = 0; n < kCountCount; ++n) {
      const Deviation one = polyline_deviation(curve, kCounts[n]);
      all[n].largest = std::max(all[n].largest, one.largest);
      all[n].mean_squared += one.mean_squared / kLines;
    }
  }
  return all;
}

}  // namespace

BicubicHermite<Eigen::Vector2d> placed_geometry(const Layer& layer, int quad) {
  BicubicHermite<Eigen::Vector2d> p = patch_geometry(layer.patches, quad);
  for (int k = 0; k < 4; ++k) {
    p.value[k] = layer.transform * p.value[k];
    for (auto* derivative : {&p.du[k], &p.dv[k], &p.duv[k]}) {
      *derivative = layer.transform.linear() * *derivative;
    }
  }
  return p;
}

PlaneCurve edge_curve(const Layer& layer, int h) {
  const PatchMesh& patches = layer.patches;
  const Eigen::Vector2d &from = patches.mesh.vertices[patches.mesh.origin(h)],
                        &to = patches.mesh.vertices[patches.mesh.tip(h)];
  PlaneCurve curve = {from, from + tangent_along(patches, h, 0) / 3,
                      to - tangent_along(patches, h, 1) / 3, to};
  for (Eigen::Vector2d& p : curve) p = layer.transform * p;
  return curve;
}

PlaneCurve side_curve(const BicubicBezier<Eigen::Vector2d>& patch, int side) {
  PlaneCurve curve;
  for (int i = 0; i < 4; ++i) {
    switch (side) {
      case 0:
        curve[i] = patch.control[0][i];
        break;
      case 1:
        curve[i] = patch.control[i][3];
        break;
      case 2:
        curve[i] = patch.control[3][3 - i];
        break;
      default:
        curve[i] = patch.control[3 - i][0];
        break;
    }
  }
  return curve;
}

double chord_distance(const PlaneCurve& curve) {
  // The curve's deviation from its chord is that of its inner control points, weighed by basis
  // functions that add up to at most 3/4.
  const Eigen::Vector2d chord = curve[3] - curve[0];
  const double length2 = chord.squaredNorm();
  double farthest = 0;
  for (int i = 1; i <= 2; ++i) {
    const Eigen::Vector2d p = curve[i] - curve[0];
    const double t = length2 > 0 ? std::clamp(p.dot(chord) / length2, 0.0, 1.0) : 0.0;
    farthest = std::max(farthest, (p - t * chord).norm());
  }
  return 0.75 * farthest;
}

Divisions bilinear_divisions(const BicubicBezier<Color>& color, double tolerance) {
  const Deviations along_u = deviations_along(color, true);
  const Deviations along_v = deviations_along(color, false);
  Divisions best = {kCounts[kCountCount - 1], kCounts[kCountCount - 1]};
  for (int i = 0; i < kCountCount; ++i) {
    for (int j = 0; j < kCountCount; ++j) {
      // The deviations of the two directions add up at worst, and are about independent on average.
      const Deviation &du = along_u[i], &dv = along_v[j];
      const bool fits = du.largest + dv.largest <= 2 * tolerance &&
                        std::sqrt(du.mean_squared + dv.mean_squared) <= 0.5 * tolerance;
      if (fits && kCounts[i] * kCounts[j] < best.u * best.v) best = {kCounts[i], kCounts[j]};
    }
  }
  return best;
}

}  // namespace quadrille
