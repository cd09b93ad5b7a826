#include "svg_calm.h"

#include <gtest/gtest.h>

#include "support/random_patches.h"

namespace quadrille {
namespace {

constexpr double kSide = 40;

/// A lattice of 10 x 10 patches with a colour and its gradient at each vertex.
template <class Paint>
Layer painted_lattice(const Paint& paint) {
  Layer layer;
  layer.patches = straight_patches(testing::lattice(10, 10, kSide, kSide));
  const QuadMesh& mesh = layer.patches.mesh;
  for (int h = 0; h < 4 * mesh.quad_count(); ++h) {
    paint(mesh.vertices[mesh.origin(h)], layer.patches.wedges[layer.patches.wedge_of_corner[h]]);
  }
  return layer;
}

double weight_of(const Layer& layer) {
  return banding_weight(SvgLayer(layer, 2.0 / 255, kSide, kSide));
}

Color gray(double value) {
  Color color = Color::Constant(static_cast<float>(value));
  color[3] = 1;
  return color;
}

TEST(BandingWeight, IsLargestWhereColoursAreLinear) {
  const Layer linear = painted_lattice([](const Eigen::Vector2d& p, Wedge& wedge) {
    wedge.value = gray(p.x() / kSide);
    wedge.dx = gray(1 / kSide) - gray(0);
  });
  EXPECT_EQ(weight_of(linear), 4);
}

TEST(BandingWeight, FallsWithTheContrastOfWhatBends) {
  const auto checkers = [](double contrast) {
    return painted_lattice([=](const Eigen::Vector2d& p, Wedge& wedge) {
      const bool odd = (std::lround(p.x() / 4) + std::lround(p.y() / 4)) % 2 != 0;
      wedge.value = gray(odd ? 0.5 + contrast / 2 : 0.5 - contrast / 2);
    });
  };
  double last = 4;
  for (const double contrast : {0.02, 0.04, 0.08}) {
    const double weight = weight_of(checkers(contrast));
    EXPECT_LT(weight, last);
    last = weight;
  }
  EXPECT_LT(weight_of(checkers(1)), 1);
}

TEST(BandingWeight, OfNothingIsOne) {
  Layer hidden =
      painted_lattice([](const Eigen::Vector2d&, Wedge& wedge) { wedge.value = Color::Zero(); });
  hidden.patches.opaque = false;
  EXPECT_EQ(weight_of(hidden), 1);
}

}  // namespace
}  // namespace quadrille
