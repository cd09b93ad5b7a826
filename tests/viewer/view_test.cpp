#include "view.h"

#include <gtest/gtest.h>

namespace quadrille::viewer {
namespace {

using Eigen::Vector2d;

View some_view() { return View({481, 321}, {800, 600}); }

TEST(View, FitsThePictureIntoTheWindow) {
  const Frame frame = some_view().frame();
  EXPECT_NEAR(frame.zoom, 800.0 / 481, 1e-12);
  EXPECT_EQ(frame.visible(), (PixelRegion{0, 0, frame.output[0], frame.output[1]}));
  EXPECT_NEAR(frame.origin.x(), 0, 1);
  EXPECT_NEAR(frame.origin.y(), (600 - frame.output[1]) / 2, 1);
}

TEST(View, OutputsAreThoseOfRender) {
  const VectorImage image = single_layer({}, 481, 321);
  View view = some_view();
  for (const double zoom : {0.05, 0.37, 1.0, 3.3, 1000.0, 1e6, 1e12}) {
    view.zoom_to(zoom);
    RenderOptions options;
    options.scale = view.frame().zoom;
    EXPECT_EQ(view.frame().output, output_size(image, options)) << zoom;
  }
}

TEST(View, ZoomingKeepsThePointUnderTheCursorAtAnyDepth) {
  View view = some_view();
  const Vector2d cursor(250.5, 410.5), middle(400, 300);
  const Vector2d point = view.center() + (cursor - middle) / view.zoom();
  for (int i = 0; i < 60; ++i) {
    view.zoom_at(cursor, 1.25);
    EXPECT_LE((view.frame().to_window(point) - cursor).norm(), 1.0) << view.zoom();
  }
  EXPECT_GT(view.zoom(), 1e6);
}

TEST(View, PanningMovesByWholePixelsAndEndsAtThePicture) {
  View view = some_view();
  view.zoom_to(8);
  const Frame before = view.frame();
  view.pan({13, -7});
  EXPECT_EQ(view.frame().origin.x() - before.origin.x(), 13);
  EXPECT_EQ(view.frame().origin.y() - before.origin.y(), -7);
  view.pan({1e9, 1e9});
  EXPECT_EQ(view.center(), Vector2d(0, 0));
}

TEST(View, FramesMapThereAndBack) {
  View view = some_view();
  view.zoom_to(12345.678);
  view.look_at({17.25, 300.125});
  const Vector2d p(17.26, 300.13);
  EXPECT_LE((view.frame().to_picture(view.frame().to_window(p)) - p).norm(), 1e-9);
}

}  // namespace
}  // namespace quadrille::viewer
