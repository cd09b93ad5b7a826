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

TEST(FitCells, WholeStepsTakeOneCellAtTheLeastTolerance) {
  for (const int step : {0, 100, 255}) {
    PatchMesh patches = straight_patches(testing::lattice(1, 1, kSize, kSize));
    const float gray = float(step) / 255;
    testing::set_linear_colors(patches, Color(gray, gray, gray, 1), Color::Zero(), Color::Zero());
    const VectorImage image = testing::single_layer(std::move(patches), kSize, kSize);
    const PatchCells cells = fit_cells(image.layers[0], 0, ShadedQuantity::color, 0.5);
    EXPECT_EQ(cells.count.u, 1) << step;
    EXPECT_EQ(cells.count.v, 1) << step;
  }
}

}  // namespace
}  // namespace quadrille
