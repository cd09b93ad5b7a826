#include "quadrille/raster_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "quadrille/error.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "raster_stream.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A smooth picture whose samples are exact in `bits`.
Raster gradient(int width, int height, int channels, int bits) {
  const float full = bits == 8 ? 255.0f : 65535.0f;
  Raster picture(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        const double v = 0.5 + 0.5 * std::sin(0.05 * (x + 2 * y) + c);
        picture.pixel(x, y)[c] = static_cast<float>(std::round(v * full)) / full;
      }
    }
  }
  return picture;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class RasterFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("quadrille_raster_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  ErrorCode code_of(const Raster& picture, const char* name, const RasterFileOptions& options) {
    try {
      save_raster(picture, folder_ / name, options);
    } catch (const Error& error) {
      return error.code();
    }
    ADD_FAILURE() << name << " was written";
    return {};
  }
  auto entries() const { return std::distance(fs::directory_iterator(folder_), {}); }

  fs::path folder_;
};

TEST_F(RasterFile, LosslessFormatsComeBackExactly) {
  for (const char* name : {"a.png", "a.tif", "a.TIFF"}) {
    for (const int channels : {3, 4}) {
      for (const int bits : {8, 16}) {
        const Raster picture = gradient(37, 21, channels, bits);
        RasterFileOptions options;
        options.bits = bits;
        save_raster(picture, folder_ / name, options);
        EXPECT_EQ(load_image(folder_ / name), picture) << name << channels << bits;
      }
    }
  }
}

TEST_F(RasterFile, LossyFormatsComeClose) {
  for (const char* name : {"a.jpg", "a.jpeg", "a.webp"}) {
    const Raster picture = gradient(64, 48, 3, 8);
    save_raster(picture, folder_ / name);
    const Raster loaded = load_image(folder_ / name);
    EXPECT_EQ(loaded.channels, 3);
    EXPECT_GT(compare(loaded, picture).psnr, 32) << name;
  }
  save_raster(gradient(64, 48, 4, 8), folder_ / "alpha.webp");
  EXPECT_EQ(load_image(folder_ / "alpha.webp").channels, 4);
}

TEST_F(RasterFile, QualityDecidesTheSize) {
  const Raster picture = gradient(200, 200, 3, 8);
  RasterFileOptions low, high;
  low.quality = 20;
  high.quality = 98;
  save_raster(picture, folder_ / "low.jpg", low);
  save_raster(picture, folder_ / "high.jpg", high);
  EXPECT_LT(fs::file_size(folder_ / "low.jpg"), fs::file_size(folder_ / "high.jpg"));
}

TEST_F(RasterFile, JpegPutsTheBackgroundBehindTransparency) {
  Raster picture(32, 32, 4);
  for (int i = 0; i < 32 * 32; ++i) {
    picture.data[4 * i] = 1;
    picture.data[4 * i + 3] = 0.25f;
  }
  RasterFileOptions options;
  options.background = {0, 0, 1};
  options.quality = 100;
  save_raster(picture, folder_ / "a.jpg", options);
  const Raster loaded = load_image(folder_ / "a.jpg");
  ASSERT_EQ(loaded.channels, 3);
  EXPECT_NEAR(loaded.pixel(16, 16)[0], 0.25, 0.02);
  EXPECT_NEAR(loaded.pixel(16, 16)[1], 0, 0.02);
  EXPECT_NEAR(loaded.pixel(16, 16)[2], 0.75, 0.02);
}

TEST_F(RasterFile, ValuesOutsideTheRangeAreClamped) {
  Raster picture(2, 1, 3);
  picture.data = {-1, 2, 0.5f, 0, 1, -0.0f};
  save_raster(picture, folder_ / "a.png");
  EXPECT_THAT(load_image(folder_ / "a.png").data,
              testing::Pointwise(testing::FloatNear(0.003f), {0.f, 1.f, 0.5f, 0.f, 1.f, 0.f}));
}

TEST_F(RasterFile, TheSameBytesEveryTime) {
  const Raster picture = gradient(300, 200, 4, 8);
  for (const char* ending : {".png", ".jpg", ".webp", ".tif"}) {
    save_raster(picture, folder_ / (std::string("a") + ending));
    save_raster(picture, folder_ / (std::string("b") + ending));
    EXPECT_EQ(bytes_of(folder_ / (std::string("a") + ending)),
              bytes_of(folder_ / (std::string("b") + ending)))
        << ending;
  }
}

TEST_F(RasterFile, TellsWhatItCannotWrite) {
  const Raster picture = gradient(4, 4, 3, 8);
  try {
    save_raster(picture, folder_ / "a.bmp");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported_format);
    EXPECT_THAT(error.what(), HasSubstr(".png"));
  }
  RasterFileOptions options;
  options.bits = 16;
  EXPECT_EQ(code_of(picture, "a.jpg", options), ErrorCode::invalid_argument);
  options.bits = 12;
  EXPECT_EQ(code_of(picture, "a.png", options), ErrorCode::invalid_argument);
  options.bits = 8;
  options.quality = 0;
  EXPECT_EQ(code_of(picture, "a.jpg", options), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(Raster(16400, 1, 3), "a.webp", {}), ErrorCode::limit_exceeded);
  EXPECT_EQ(code_of(picture, "none/a.png", {}), ErrorCode::io_failure);
  EXPECT_EQ(entries(), 0);
}

TEST_F(RasterFile, StripsJoinSeamlesslyAndComeOnce) {
  constexpr int kWidth = 800, kHeight = 410;
  const auto value = [](int x, int y) { return static_cast<std::uint8_t>((x + 3 * y) % 256); };
  std::vector<int> drawn(kHeight, 0);
  RasterStream stream{kWidth, kHeight, false,
                      [&](int y, int rows, const PixelLayout& layout, const PixelBuffer& buffer) {
                        EXPECT_TRUE(layout == (PixelLayout{SampleType::uint8, 3}));
                        for (int j = 0; j < rows; ++j) {
                          ++drawn[y + j];
                          auto* const row =
                              static_cast<std::uint8_t*>(buffer.pixels) + j * buffer.row_bytes;
                          for (int x = 0; x < kWidth; ++x)
                            std::fill_n(row + 3 * x, 3, value(x, y + j));
                        }
                      }};
  stream.strip_pixels = 800 * 30;
  for (const char* name : {"a.tif", "a.png"}) {
    std::fill(drawn.begin(), drawn.end(), 0);
    write_stream(stream, folder_ / name, {});
    EXPECT_THAT(drawn, testing::Each(1));
    const Raster loaded = load_image(folder_ / name);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) ASSERT_EQ(loaded.pixel(x, y)[1], value(x, y) / 255.0f);
    }
  }
}

TEST_F(RasterFile, WhatTheDrawingThrowsReachesTheCaller) {
  RasterStream stream{100, 100, false, [](int, int, const PixelLayout&, const PixelBuffer&) {
                        throw Error(ErrorCode::cancelled, "stopped");
                      }};
  for (const char* name : {"a.png", "a.tif", "a.dzi"}) {
    try {
      write_stream(stream, folder_ / name, {});
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
  }
  EXPECT_EQ(entries(), 0);
}

TEST_F(RasterFile, WritesAPyramidAndReplacesItWhole) {
  const auto levels = [&](const char* tiles) {
    int count = 0;
    for (const auto& level : std::filesystem::directory_iterator(folder_ / tiles)) {
      count += level.is_directory();
    }
    return count;
  };
  save_raster(Raster(600, 300, 3), folder_ / "a.dzi");
  EXPECT_EQ(levels("a_files"), 11);  // sides of 1 to 600: 2^0 ... 2^10 above
  save_raster(Raster(60, 30, 4), folder_ / "a.dzi");
  EXPECT_EQ(levels("a_files"), 7);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a_files" / "6" / "0_0.png"));
  EXPECT_EQ(entries(), 2);
  // A folder of that name that is no pyramid's stays.
  std::filesystem::create_directory(folder_ / "b_files");
  EXPECT_THROW(save_raster(Raster(60, 30, 3), folder_ / "b.dzi"), Error);
  EXPECT_EQ(entries(), 3);
}

}  // namespace
}  // namespace quadrille
