#include "quadrille/scene_window.h"

#include <gtest/gtest.h>

#include <cmath>

#include "quadrille/picture_layers.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

Vector2d cubic(const std::array<Vector2d, 4>& p, double t) {
  const double s = 1 - t;
  return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - (a + t * (b - a))).norm();
}

TEST(CurveSegments, KeepThePolylineWithinAnyTolerance) {
  const std::array<Vector2d, 4> curve = {Vector2d(0, 0), {40, 90}, {70, -60}, {100, 20}};
  for (const double tolerance : {10.0, 1.0, 0.1, 0.01}) {
    const int n = curve_segments(curve, tolerance);
    double worst = 0;
    for (int i = 0; i < n; ++i) {
      const Vector2d a = cubic(curve, static_cast<double>(i) / n);
      const Vector2d b = cubic(curve, static_cast<double>(i + 1) / n);
      for (int k = 1; k < 16; ++k) {
        worst = std::max(worst, distance_to_segment(cubic(curve, (i + k / 16.0) / n), a, b));
      }
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_GE(worst, tolerance / 40) << "more pieces than it takes";
  }
}

TEST(CurveSegments, AreOneForAStraightLine) {
  EXPECT_EQ(curve_segments({Vector2d(0, 0), {1, 1}, {2, 2}, {3, 3}}, 1e-6), 1);
}

TEST(EdgeLayer, LeavesOutWhatAWindowDoesNotShow) {
  const VectorImage image = single_layer(testing::random_patches(5, 4, 53, 37, 11), 53, 37);
  const SceneWindow whole{{Vector2d(-100, -100), Vector2d(200, 200)}, 0.01};
  const SceneWindow corner{{Vector2d(-1, -1), Vector2d(1, 1)}, 0.01};
  const SceneLayer all = edge_layer(image), shown = edge_layer(image, whole),
                   few = edge_layer(image, corner);
  const auto cells = [](const SceneLayer& layer) {
    return std::get<SceneShapes>(layer.content).cell_count();
  };
  EXPECT_EQ(cells(shown), cells(all));
  EXPECT_GE(cells(few), 2);
  EXPECT_LE(cells(few), 4);
}

}  // namespace
}  // namespace quadrille
