#include <gtest/gtest.h>

#include "quadrille/image_file.h"
#include "window_driver.h"

namespace quadrille::viewer {
namespace {

using Eigen::Array2i;
using Eigen::Vector2d;

/// Pixels of the source, each as large as `zoom` whole pixels of the window.
Raster expected_source(const Raster& source, const Frame& frame) {
  Raster expected(frame.window.x(), frame.window.y(), 3);
  const PixelRegion visible = frame.visible();
  for (int y = visible.y; y < visible.y + visible.height; ++y) {
    for (int x = visible.x; x < visible.x + visible.width; ++x) {
      const float* p =
          source.pixel(static_cast<int>(x / frame.zoom), static_cast<int>(y / frame.zoom));
      std::copy_n(p, 3, expected.pixel(x + frame.origin.x(), y + frame.origin.y()));
    }
  }
  return expected;
}

TEST(Compare, TheSliderPartsSourceAndPicture) {
  WindowDriver driver(small_subject());
  driver.session().view.zoom_to(8);
  driver.key("c");
  const Subject& subject = driver.window().subject();
  const Frame frame = driver.session().view.frame();
  const Raster source = expected_source(*subject.source, frame);
  const Raster picture = expected_picture(subject, frame);
  for (const int column : {160, 60, 250}) {
    driver.drag({driver.session().divider_column() + 2, 100}, {column, 90});
    ASSERT_EQ(driver.session().divider_column(), column);
    const Raster seen = driver.scene();
    EXPECT_LE(largest_difference(seen, source, 0, column - 3), 1.001);
    EXPECT_LE(largest_difference(seen, picture, column + 3, 320), 1.001);
  }
  driver.key("c");
  expect_same(picture, driver.scene(), 1, "compared");
}

TEST(Mouse, DraggingMovesThePicture) {
  WindowDriver driver(small_subject());
  driver.key("8");
  const Array2i before = driver.session().view.frame().origin;
  driver.drag({100, 100}, {141, 77});
  EXPECT_TRUE((driver.session().view.frame().origin - before == Array2i(41, -23)).all());
  EXPECT_FALSE(driver.session().picked) << "a drag is no click";
}

TEST(Mouse, TheWheelZoomsAtTheCursor) {
  WindowDriver driver(small_subject());
  const Vector2d cursor(201, 99);
  const Vector2d point = driver.session().view.frame().to_picture(cursor);
  const double zoom = driver.session().view.zoom();
  driver.wheel(201, 99, 6);
  EXPECT_GT(driver.session().view.zoom(), 3 * zoom);
  EXPECT_LE((driver.session().view.frame().to_window(point) - cursor).norm(), 4);
  driver.wheel(201, 99, -6);
  EXPECT_NEAR(driver.session().view.zoom(), zoom, 1e-9);
}

TEST(Mouse, AClickPicksThePatchOrTheVertex) {
  WindowDriver driver(small_subject());
  driver.session().view.zoom_to(4);
  const PatchMesh& patches = driver.window().subject().image->layers[0].patches;
  const Frame frame = driver.session().view.frame();
  const auto click = [&](const Vector2d& p) {
    const Vector2d at = frame.to_window(p);
    driver.click(static_cast<int>(at.x()), static_cast<int>(at.y()));
  };
  const Raster before = driver.scene();
  for (int q = 0; q < patches.patch_count(); q += 5) {
    click(patch_geometry(patches, q).at(0.5, 0.5));
    ASSERT_TRUE(driver.session().picked);
    EXPECT_EQ(driver.session().picked->kind, Pick::Kind::patch);
    EXPECT_EQ(driver.session().picked->index, q);
  }
  EXPECT_GT(largest_difference(before, driver.scene(), 0, 320), 50) << "it stands out";
  click(patches.mesh.vertices[4]);
  EXPECT_EQ(driver.session().picked->kind, Pick::Kind::vertex);
  EXPECT_EQ(driver.session().picked->index, 4);
  driver.key("Escape");
  EXPECT_FALSE(driver.session().picked);
  expect_same(before, driver.scene(), 0, "let-go");
}

TEST(Keys, PanelsAndHelpComeAndGo) {
  WindowDriver driver(small_subject(), {}, {1000, 700});
  const Raster plain = driver.scene(), panels = driver.window().pixels(true);
  EXPECT_GT(largest_difference(plain, panels, 0, 1000), 100);
  driver.key("h");
  EXPECT_GT(largest_difference(panels, driver.window().pixels(true), 400, 600), 100);
  driver.key("question");
  expect_same(panels, driver.window().pixels(true), 0, "help");
  driver.key("b");
  EXPECT_FALSE(driver.session().panels);
}

TEST(Keys, SSavesTheViewWithoutPanels) {
  WindowDriver driver(small_subject());
  driver.session().layers.set_shown(LayerId::patches, true);
  for (int i = 0; i < 2; ++i) {
    driver.key("s");
    ASSERT_FALSE(driver.window().last_saved().empty());
    expect_same(driver.scene(), load_image(driver.window().last_saved()), 0, "saved");
  }
  EXPECT_EQ(driver.window().last_saved().filename(), "saved-2.png");
}

TEST(Keys, ZoomAndFit) {
  WindowDriver driver(small_subject());
  for (const auto& [key, zoom] :
       {std::pair{"1", 1.0}, {"2", 2.0}, {"4", 4.0}, {"8", 8.0}, {"f", 5.0}}) {
    driver.key(key);
    EXPECT_EQ(driver.session().view.zoom(), zoom);
  }
}

TEST(Keys, SelectLayers) {
  WindowDriver driver(small_subject());
  driver.key("Down");
  EXPECT_EQ(driver.session().layers.selected(), LayerId::error);
  driver.key("Up");
  driver.key("Up");
  EXPECT_EQ(driver.session().layers.selected(), LayerId::source);
  driver.key("Tab");
  EXPECT_EQ(driver.session().layers.selected(), LayerId::picture);
}

TEST(Keys, ThoseOfVtkDoNothing) {
  WindowDriver driver(small_subject());
  const Raster before = driver.scene();
  for (const char* key : {"w", "r", "j", "u", "3", "a", "F1"}) driver.key(key);
  expect_same(before, driver.scene(), 0, "foreign-keys");
}

TEST(Keys, QEndsTheProgram) {
  WindowDriver driver(small_subject());
  driver.key("q");
  EXPECT_TRUE(driver.window().interactor()->GetDone());
}

}  // namespace
}  // namespace quadrille::viewer
