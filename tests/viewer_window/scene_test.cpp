#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clip_shapes.h"
#include "support/random_patches.h"
#include "window_driver.h"

namespace quadrille::viewer {
namespace {

using Eigen::Vector2d;

TEST(Scene, ThePictureIsTheRasterizersAtAnyZoom) {
  WindowDriver driver(small_subject());
  for (const double zoom : {0.4, 1.0, 3.7, 5.0, 64.0, 5000.0, 1e6}) {
    driver.session().view.zoom_to(zoom);
    for (const Vector2d& center : {Vector2d(32, 24), {18.01, 22.003}, {60, 40}}) {
      driver.session().view.look_at(center);
      expect_same(expected_picture(driver.window().subject(), driver.session().view.frame()),
                  driver.scene(), 1, "zoom");
    }
  }
}

TEST(Scene, TransparentPicturesLieOnACheckerboard) {
  PatchMesh patches = testing::random_patches(4, 3, 64, 48, 5);
  testing::set_random_colors(patches, 6, /*opaque=*/false);
  Subject subject;
  subject.image = std::make_shared<const VectorImage>(single_layer(std::move(patches), 64, 48));
  WindowDriver driver(subject);
  driver.session().view.zoom_to(3);
  const Frame frame = driver.session().view.frame();
  RenderOptions options;
  options.scale = 3;
  const Raster drawn = render(*subject.image, options), seen = driver.scene();
  for (int y = 0; y < drawn.height; ++y) {
    for (int x = 0; x < drawn.width; ++x) {
      const float* p = drawn.pixel(x, y);
      const float paper = (x / 8 + y / 8) % 2 ? 0.8f : 1.0f;
      const float* shown = seen.pixel(x + frame.origin.x(), y + frame.origin.y());
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(255 * shown[c], 255 * (paper + p[3] * (p[c] - paper)), 2) << x << ' ' << y;
      }
    }
  }
}

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double length = (b - a).squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0;
  return (p - (a + t * (b - a))).norm();
}

/// Distance in window pixels from a layer's lines and points, arms of crosses included.
double distance_to(const SceneLayer& layer, const Frame& frame, const Vector2d& place) {
  const auto* shapes = std::get_if<SceneShapes>(&layer.content);
  if (!shapes) return 0;  // of a grid, which is everywhere
  double distance = 1e9;
  const auto at = [&](int p) { return frame.to_window(shapes->points[p]); };
  for (int c = 0; c < shapes->cell_count(); ++c) {
    for (int k = shapes->cell_begin[c]; k + 1 < shapes->cell_begin[c + 1]; ++k) {
      distance = std::min(distance, distance_to_segment(place, at(shapes->cell_points[k]),
                                                        at(shapes->cell_points[k + 1])));
    }
  }
  if (shapes->cell != SceneShapes::Cell::point) return distance;
  for (std::size_t i = 0; i < shapes->points.size(); ++i) {
    const double reach = layer.style.marker == Marker::cross ? 40 : 4;
    distance = std::min(distance, (place - at(static_cast<int>(i))).norm() - reach);
  }
  return distance;
}

/// The subject with its stages.
Subject with_stages() {
  Subject subject = small_subject();
  VectorizeOptions options;
  options.quads = 100;
  subject.stages = std::make_shared<const Quadrangulation>(quadrangulate(*subject.source, options));
  return subject;
}

class EachLayer : public ::testing::TestWithParam<int> {};

TEST_P(EachLayer, ItsKeyChangesPixelsWhereItHasSomethingAndNowhereElse) {
  const LayerInfo& info = layer_infos()[GetParam()];
  WindowDriver driver(with_stages());
  driver.session().layers.set_shown(LayerId::picture, info.id == LayerId::source);
  const Raster without = driver.scene();
  driver.key(std::string(1, info.key));
  const Raster with = driver.scene();
  const Frame frame = driver.session().view.frame();
  SubjectLayers layers(driver.window().subject());
  int changed = 0;
  for (int y = 0; y < with.height; ++y) {
    for (int x = 0; x < with.width; ++x) {
      if (std::equal(with.pixel(x, y), with.pixel(x, y) + 3, without.pixel(x, y))) continue;
      ++changed;
      double distance = 1e9;
      for (const SceneLayer& layer : layers.layers(info.id, frame, 0)) {
        distance = std::min(distance, distance_to(layer, frame, Vector2d(x + 0.5, y + 0.5)));
      }
      ASSERT_LE(distance, 3) << info.name << " at " << x << ' ' << y;
    }
  }
  // The sources and the picture differ little, and singularities may be none.
  if (info.id != LayerId::singularities && info.id != LayerId::source) {
    EXPECT_GT(changed, 40) << info.name;
  }
  driver.key(std::string(1, info.key));
  expect_same(without, driver.scene(), 0, "toggled-twice");
}

INSTANTIATE_TEST_SUITE_P(Layers, EachLayer, ::testing::Range(0, kLayerCount),
                         [](const auto& layer) {
                           std::string name = layer_infos()[layer.param].name;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(Scene, FadingALayerMixesItIn) {
  WindowDriver driver(small_subject());
  const Raster plain = driver.scene();
  driver.key("m");
  const Raster full = driver.scene();
  for (int i = 0; i < 5; ++i) driver.key("minus");
  EXPECT_EQ(driver.session().layers.opacity(LayerId::patches), 0.5);
  const Raster half = driver.scene();
  // Away from places where lines cross and cover each other.
  long long compared = 0, far = 0;
  for (std::size_t i = 0; i < plain.data.size(); ++i) {
    if (full.data[i] == plain.data[i]) continue;
    ++compared;
    far += std::abs(half.data[i] - (plain.data[i] + full.data[i]) / 2) > 2.5 / 255;
  }
  EXPECT_GT(compared, 1000);
  EXPECT_LT(far, compared / 20);
  driver.key("plus");
  EXPECT_EQ(driver.session().layers.opacity(LayerId::patches), 0.6);
}

TEST(Scene, PanningShowsWhatDrawingAnewShows) {
  WindowDriver driver(small_subject());
  driver.session().layers = parse_layers("picture,patches,control-net,tears,irregular-vertices");
  driver.key("8");
  for (int i = 0; i < 30; ++i) driver.drag({150, 120}, {150 - 9, 120 - 7});
  const Raster panned = driver.scene();
  WindowDriver anew(driver.window().subject());
  anew.session() = driver.session();
  expect_same(anew.scene(), panned, 2, "panned");
}

TEST(Scene, ResizingKeepsTheMiddle) {
  WindowDriver driver(small_subject());
  driver.key("8");
  const Vector2d center = driver.session().view.center();
  driver.window().interactor()->GetRenderWindow()->SetSize(240, 200);
  driver.window().draw();
  EXPECT_EQ(driver.session().view.center(), center);
  expect_same(expected_picture(driver.window().subject(), driver.session().view.frame()),
              driver.scene(), 1, "resized");
}

}  // namespace
}  // namespace quadrille::viewer
