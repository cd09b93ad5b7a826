#include "quadrille/preset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "quadrille/error.h"

namespace quadrille {
namespace {

/// A grey picture of the given values; value(x, y) in [0, 1].
template <class Value>
Raster drawn(int width, int height, const Value& value) {
  Raster picture(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = value(x, y);
    }
  }
  return picture;
}

Raster two_halves(int width, int height) {
  return drawn(width, height, [=](int x, int) { return 2 * x < width ? 0.2f : 0.9f; });
}

Raster noise(int width, int height) {
  std::mt19937 random(1);
  return drawn(width, height, [&](int, int) { return (random() % 256) / 255.0f; });
}

Raster color_ramp(int size) {
  Raster picture(size, size, 3);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      float* const p = picture.pixel(x, y);
      p[0] = static_cast<float>(x) / static_cast<float>(size);
      p[1] = static_cast<float>(y) / static_cast<float>(size);
      p[2] = 0.5f * (p[0] + p[1]);
    }
  }
  return picture;
}

/// A disc of half the width in the middle, transparent around it.
Raster disc_with_alpha(int size) {
  Raster picture(size, size, 4);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      float* const p = picture.pixel(x, y);
      p[0] = static_cast<float>(x) / static_cast<float>(size);
      p[3] = std::hypot(x - 0.5 * size, y - 0.5 * size) < 0.25 * size ? 1.0f : 0.0f;
    }
  }
  return picture;
}

TEST(Content, OfTwoFlatHalves) {
  const Content content = classify_content(two_halves(100, 60));
  EXPECT_EQ(content.width, 100);
  EXPECT_EQ(content.height, 60);
  EXPECT_DOUBLE_EQ(content.flat_share, 0.99);  // one column differs from its right neighbour
  EXPECT_EQ(content.main_colors, 2);
  EXPECT_EQ(content.transparent_share, 0);
}

TEST(Content, MainColorsLeaveOutATenth) {
  const Raster stripe = drawn(100, 10, [](int x, int) { return x < 9 ? 1.0f : 0.0f; });
  EXPECT_EQ(classify_content(stripe).main_colors, 1);
}

TEST(Content, OfNoise) {
  const Content content = classify_content(noise(200, 100));
  EXPECT_LT(content.flat_share, 0.01);
  EXPECT_GT(content.main_colors, 25);  // 32 greys at 5 bits
}

TEST(Content, TransparentPixelsCountOnlyAsSuch) {
  const Raster disc = disc_with_alpha(200);
  const Content content = classify_content(disc);
  EXPECT_NEAR(content.transparent_share, 1 - std::acos(-1.0) / 16, 0.005);
  Raster clear(20, 20, 4);
  EXPECT_EQ(classify_content(clear).transparent_share, 1);
  EXPECT_EQ(classify_content(clear).main_colors, 0);
}

TEST(Preset, ChosenByContent) {
  EXPECT_EQ(choose_preset(two_halves(300, 200)).name, "graphic");
  EXPECT_EQ(choose_preset(noise(300, 200)).name, "photo");
  EXPECT_EQ(choose_preset(color_ramp(200)).name, "photo");
  EXPECT_EQ(choose_preset(disc_with_alpha(200)).name, "icon");
  EXPECT_NE(choose_preset(disc_with_alpha(600)).name, "icon");  // too large
  EXPECT_EQ(choose_preset(Raster(1, 1, 3)).name, "graphic");
}

TEST(Preset, BudgetsFollowTheSize) {
  EXPECT_EQ(preset_quads(preset_named("photo"), 481, 321), 3000);
  EXPECT_EQ(preset_quads(preset_named("photo"), 2 * 481, 2 * 321), 12'000);
  EXPECT_EQ(preset_quads(preset_named("graphic"), 640, 360), 7900);
  EXPECT_EQ(preset_quads(preset_named("icon"), 256, 256), 3000);
  for (const Preset& preset : presets()) {
    EXPECT_EQ(preset_quads(preset, 1, 1), 1) << preset.name;
    EXPECT_EQ(preset_quads(preset, 1, 10), 4) << preset.name;
    EXPECT_EQ(preset_quads(preset, 100, 100), preset.min_quads) << preset.name;
    EXPECT_EQ(preset_quads(preset, 100'000, 100'000), preset.max_quads) << preset.name;
  }
}

TEST(Preset, ApplyLeavesOtherOptionsAlone) {
  VectorizeOptions options;
  options.lattice = true;
  options.fit.method = FitMethod::bessel;
  apply(preset_named("fine"), two_halves(200, 200), options);
  EXPECT_EQ(options.quads, 2000);
  EXPECT_TRUE(options.lattice);
  EXPECT_EQ(options.fit.method, FitMethod::bessel);
}

TEST(Preset, ApplyTearsDrawingsStrongly) {
  const VectorizeOptions usual;
  for (const char* name : {"graphic", "icon"}) {
    SCOPED_TRACE(name);
    VectorizeOptions options;
    apply(preset_named(name), two_halves(600, 400), options);
    EXPECT_EQ(options.quads, preset_quads(preset_named(name), 600, 400));
    EXPECT_EQ(options.tears.mode, TearOptions::Mode::strong);
    EXPECT_EQ(options.chains.sharpness, 0.8);
    EXPECT_LT(options.chains.sharpness, usual.chains.sharpness);
    EXPECT_EQ(options.chain_share, 0.6);
    EXPECT_EQ(options.least_chain_gain, 0);
    EXPECT_EQ(options.fit.smoothness, 0.25);
  }
  for (const char* name : {"draft", "photo", "fine"}) {
    SCOPED_TRACE(name);
    VectorizeOptions options;
    apply(preset_named(name), two_halves(600, 400), options);
    EXPECT_EQ(options.tears.mode, TearOptions::Mode::automatic);
    EXPECT_EQ(options.chains.sharpness, usual.chains.sharpness);
    EXPECT_EQ(options.chain_share, usual.chain_share);
    EXPECT_EQ(options.least_chain_gain, usual.least_chain_gain);
    EXPECT_EQ(options.fit.smoothness, usual.fit.smoothness);
  }
}

TEST(Preset, UnknownNamesAreRefused) {
  try {
    preset_named("poster");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
    EXPECT_NE(std::string(error.what()).find("graphic"), std::string::npos);
  }
}

}  // namespace
}  // namespace quadrille
