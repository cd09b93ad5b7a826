#include "pdf_cells.h"

#include <gtest/gtest.h>

#include "support/random_patches.h"

namespace quadrille {
namespace {

constexpr double kSize = 48;

TEST(FitCells, RoundingColorsUpIsNoErrorThatMoreCellsCouldMend) {
  PatchMesh patches = straight_patches(testing::lattice(3, 3, kSize, kSize));
  const float per_pixel = 0.7f / kSize;
  testing::set_linear_colors(patches, Color(0.1f, 0.9f, 0.4f, 1), Color(per_pixel, 0, 0, 0),
                             Color(0, -per_pixel, 0, 0));
  const VectorImage image = testing::single_layer(std::move(patches), kSize, kSize);
  // Half of it in the mean is less than what the rounding up adds, 3/8 of a step.
  constexpr double kTolerance = 0.7;
  for (int q = 0; q < 9; ++q) {
    const PatchCells cells = fit_cells(image.layers[0], q, ShadedQuantity::color, kTolerance);
    EXPECT_EQ(cells.count.u, 1) << q;
    EXPECT_EQ(cells.count.v, 1) << q;
  }
}

}  // namespace
}  // namespace quadrille
