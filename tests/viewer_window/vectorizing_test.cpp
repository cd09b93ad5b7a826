#include <gtest/gtest.h>

#include "window_driver.h"

namespace quadrille::viewer {
namespace {

/// A window with a source alone, as for a picture that was opened, and sliders.
class Vectorizing : public ::testing::Test {
 protected:
  Vectorizing() : driver(source_alone(), few_quads(), {800, 600}) {
    driver.window().add_sliders();
    driver.window().draw();
  }

  static Subject source_alone() {
    Subject subject;
    subject.source = small_source();
    return subject;
  }
  static VectorizeOptions few_quads() {
    VectorizeOptions options;
    options.quads = 80;
    options.optimize.rounds = 1;
    return options;
  }
  ViewerWindow& window() { return driver.window(); }

  WindowDriver driver;
};

// Where the tubes of the sliders lie in a window of 800 x 600.
constexpr int kSliderRow = 552, kQuadsLeft = 448, kQuadsRight = 600, kLambdaLeft = 632;

TEST_F(Vectorizing, ShowsTheSourceUntilThereIsAPicture) {
  driver.session().view.zoom_to(1);
  const Raster seen = driver.scene();
  const Frame frame = driver.session().view.frame();
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float* p = seen.pixel(x + frame.origin.x(), y + frame.origin.y());
      ASSERT_NEAR(p[0], window().subject().source->pixel(x, y)[0], 1.01 / 255);
    }
  }
  window().vectorize_again();
  window().finish_background();
  ASSERT_TRUE(window().subject().image);
  expect_same(expected_picture(window().subject(), frame), driver.scene(), 1, "vectorized");
}

TEST_F(Vectorizing, SlidersVectorizeAnewAndKeepTheView) {
  window().vectorize_again();
  window().finish_background();
  const int before = window().subject().image->patch_count();
  driver.wheel(300, 200, 3);
  const Frame frame = driver.session().view.frame();

  // The drag's value takes the place of the click's, whose run is cancelled.
  driver.click(kQuadsLeft + 60, kSliderRow);
  driver.drag({kQuadsLeft + 60, kSliderRow}, {kQuadsRight - 10, kSliderRow});
  EXPECT_GT(window().options().quads, 300);
  window().finish_background();
  EXPECT_GT(window().subject().image->patch_count(), 2 * before);
  EXPECT_EQ(driver.session().view.frame(), frame);

  const double lambda = window().options().cross_field.alignment;
  driver.click(kLambdaLeft + 30, kSliderRow);
  EXPECT_LT(window().options().cross_field.alignment, lambda / 2);
  const auto image = window().subject().image;
  window().finish_background();
  EXPECT_NE(window().subject().image, image);
}

TEST_F(Vectorizing, EscapeStops) {
  driver.click(kQuadsRight - 10, kSliderRow);
  driver.key("Escape");
  EXPECT_FALSE(window().background().progress().running);
  window().finish_background();
  EXPECT_FALSE(window().subject().image);
}

TEST_F(Vectorizing, FieldsAreComputedWhenAskedFor) {
  driver.key("x");
  window().finish_background();
  EXPECT_TRUE(window().subject().stages);
  driver.key("x");
  const Raster without = driver.scene();
  driver.key("x");
  EXPECT_FALSE(window().background().progress().running) << "they are there";
  EXPECT_GT(largest_difference(without, driver.scene(), 0, 800), 50);
}

}  // namespace
}  // namespace quadrille::viewer
