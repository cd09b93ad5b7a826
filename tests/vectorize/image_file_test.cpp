#include "quadrille/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "quadrille/error.h"
#include "quadrille/metrics.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

fs::path sample(const std::string& name) {
  return fs::path(QUADRILLE_SOURCE_DIR) / "samples" / name;
}

Raster format(const std::string& name) { return load_image(sample("formats/" + name)); }

/// Entries of the manifest whose file lies in a folder.
std::vector<nlohmann::json> manifest_of(const std::string& folder) {
  std::ifstream file(sample("manifest.json"));
  std::vector<nlohmann::json> entries;
  const nlohmann::json manifest = nlohmann::json::parse(file);
  for (const auto& entry : manifest["files"]) {
    if (entry["file"].get<std::string>().starts_with(folder + "/")) entries.push_back(entry);
  }
  EXPECT_FALSE(entries.empty()) << folder;
  return entries;
}

std::array<double, 3> mean(const Raster& picture) {
  std::array<double, 3> sum{};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c) sum[c] += picture.pixel(x, y)[c];
    }
  }
  for (double& s : sum) s /= static_cast<double>(picture.width) * picture.height;
  return sum;
}

Raster half_size(const Raster& picture) {
  Raster half(picture.width / 2, picture.height / 2, picture.channels);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      for (int c = 0; c < half.channels; ++c) {
        half.pixel(x, y)[c] =
            (picture.pixel(2 * x, 2 * y)[c] + picture.pixel(2 * x + 1, 2 * y)[c] +
             picture.pixel(2 * x, 2 * y + 1)[c] + picture.pixel(2 * x + 1, 2 * y + 1)[c]) /
            4;
      }
    }
  }
  return half;
}

/// Distance of the samples from the nearest 8-bit value, at most 0.5 / 255, in 8-bit steps.
double largest_distance_from_8_bits(const Raster& picture) {
  double largest = 0;
  for (const float v : picture.data) {
    largest = std::max(largest, std::abs(v * 255.0 - std::round(v * 255.0)));
  }
  return largest;
}

Error error_of(const fs::path& path, const ImageLimits& limits = {}) {
  try {
    load_image(path, limits);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << path << " was accepted";
  return {ErrorCode::cancelled, ""};
}

/// One sentence that names the file and says what to do.
void expect_clear(const Error& error, const fs::path& path) {
  EXPECT_THAT(error.what(), HasSubstr(path.filename().string()));
  EXPECT_THAT(error.what(), HasSubstr("; "));
  EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
}

TEST(ImageFile, WideGamutIsConverted) {
  const Raster converted = format("tulips_displayp3.png");
  const Raster reference = half_size(load_image(sample("pictures/flower_tulips.png")));
  ASSERT_EQ(converted.width, reference.width);
  const ImageDifference d = compare(converted, reference);
  EXPECT_GT(d.psnr, 35);
  const auto a = mean(converted), b = mean(reference);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 0.01) << c;
}

TEST(ImageFile, AdobeRgbAndCmykComeNearTheOriginal) {
  const Raster original = half_size(load_image(sample("pictures/object_coffee.png")));
  EXPECT_GT(compare(format("coffee_adobergb.jpg"), original).psnr, 30);
  // Without a profile the inks are anybody's guess; the picture must not be inverted or tinted.
  EXPECT_GT(compare(format("coffee_cmyk.jpg"), original).psnr, 20);
}

TEST(ImageFile, LinearPicturesAreEncoded) {
  const Raster linear = format("nikon_rec2020_linear_16bit.png");
  EXPECT_EQ(linear.channels, 3);
  EXPECT_GT(largest_distance_from_8_bits(linear), 0.4);
}

TEST(ImageFile, ProfilesOfSrgbLeaveTheSamplesAlone) {
  for (const char* name : {"flower_tulips.png", "animal_chelsea.png", "portrait_astronaut.png"}) {
    EXPECT_LT(largest_distance_from_8_bits(load_image(sample("pictures") / name)), 1e-4) << name;
  }
}

TEST(ImageFile, SixteenBitsKeepTheirPrecision) {
  const Raster picture = format("raccoon_16bit.png");
  EXPECT_EQ(picture.channels, 3);
  EXPECT_GT(largest_distance_from_8_bits(picture), 0.45);
  for (const float v : picture.data) {
    ASSERT_NEAR(v * 65535, std::round(v * 65535), 0.01);
  }
}

TEST(ImageFile, ExifRotationIsApplied) {
  const Raster landscape = format("exif_landscape_6.jpg");
  EXPECT_EQ(landscape.width, 1800);
  EXPECT_EQ(landscape.height, 1200);
  const Raster portrait = format("exif_portrait_8.jpg");
  EXPECT_EQ(portrait.width, 1200);
  EXPECT_EQ(portrait.height, 1800);
}

TEST(ImageFile, AlphaIsKeptOnlyWhereItMatters) {
  EXPECT_EQ(format("hibiscus_palette_alpha.png").channels, 4);
  EXPECT_EQ(format("tulips_displayp3.png").channels, 3);
  const Raster clear = format("fully_transparent.png");
  ASSERT_EQ(clear.channels, 4);
  for (std::size_t i = 3; i < clear.data.size(); i += 4) EXPECT_EQ(clear.data[i], 0);
  EXPECT_EQ(load_image(sample("pictures/ring_256_alpha.png")).channels, 4);
}

TEST(ImageFile, GrayBecomesRgb) {
  const Raster gray = format("brick_gray.jpg");
  ASSERT_EQ(gray.channels, 3);
  for (std::size_t i = 0; i < gray.data.size(); i += 3) {
    ASSERT_EQ(gray.data[i], gray.data[i + 1]);
    ASSERT_EQ(gray.data[i], gray.data[i + 2]);
  }
}

TEST(ImageFile, DegenerateSizes) {
  const Raster pixel = format("one_pixel.png");
  EXPECT_EQ(pixel.width, 1);
  EXPECT_EQ(pixel.height, 1);
  const Raster row = format("row_1000x1.png");
  EXPECT_EQ(row.width, 1000);
  EXPECT_EQ(row.height, 1);
}

TEST(ImageFile, EveryFormatLoads) {
  for (const auto& entry : manifest_of("formats")) {
    const Raster picture = load_image(sample(entry["file"]));
    const int longer = std::max(entry["width"].get<int>(), entry["height"].get<int>());
    EXPECT_EQ(std::max(picture.width, picture.height), longer) << entry["file"];
    for (const float v : picture.data) ASSERT_TRUE(v >= 0 && v <= 1) << entry["file"];
  }
}

TEST(ImageFile, EveryConformanceFileLoads) {
  for (const auto& entry : manifest_of("pngsuite")) {
    const Raster picture = load_image(sample(entry["file"]));
    EXPECT_EQ(picture.width, entry["width"].get<int>()) << entry["file"];
    EXPECT_EQ(picture.height, entry["height"].get<int>()) << entry["file"];
  }
}

TEST(ImageFile, TransparentColorOfAPngBecomesAlpha) {
  for (const char* name : {"tbbn0g04", "tbwn0g16", "tbrn2c08", "tbgn3p08"}) {
    EXPECT_EQ(load_image(sample(std::string("pngsuite/") + name + ".png")).channels, 4) << name;
  }
}

TEST(ImageFile, EveryBadFileGetsItsVerdict) {
  for (const auto& entry : manifest_of("bad")) {
    const fs::path path = sample(entry["file"]);
    if (entry["expect"] == "error") {
      expect_clear(error_of(path), path);
      continue;
    }
    try {
      EXPECT_GT(load_image(path).width, 0);
    } catch (const Error& error) {
      expect_clear(error, path);
    }
  }
}

TEST(ImageFile, ContentDecidesAndNotTheName) {
  const Raster misnamed = load_image(sample("bad/png_named.jpg"));
  EXPECT_EQ(misnamed, load_image(sample("pictures/animal_chelsea.png")));
}

TEST(ImageFile, ErrorCodesTellTheKindOfTrouble) {
  EXPECT_EQ(error_of(sample("bad/huge_header_60000x60000.png")).code(), ErrorCode::limit_exceeded);
  EXPECT_EQ(error_of(sample("bad/text.png")).code(), ErrorCode::unsupported_format);
  EXPECT_EQ(error_of(sample("bad/truncated.png")).code(), ErrorCode::io_failure);
  EXPECT_EQ(error_of(sample("bad/truncated.jpg")).code(), ErrorCode::io_failure);
  EXPECT_EQ(error_of(sample("bad/empty.png")).code(), ErrorCode::io_failure);
  EXPECT_EQ(error_of(sample("none.png")).code(), ErrorCode::io_failure);
  EXPECT_EQ(error_of(sample("formats")).code(), ErrorCode::io_failure);
}

TEST(ImageFile, TheLimitCountsPixels) {
  ImageLimits limits;
  limits.max_pixels = 999;
  EXPECT_EQ(error_of(sample("formats/row_1000x1.png"), limits).code(), ErrorCode::limit_exceeded);
  limits.max_pixels = 1000;
  EXPECT_EQ(load_image(sample("formats/row_1000x1.png"), limits).width, 1000);
}

TEST(ImageFile, VectorFilesAreNotRasterized) {
  const fs::path path = fs::path(testing::TempDir()) / "quadrille_image_file_test.svg";
  std::ofstream(path) << R"(<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>)";
  EXPECT_EQ(error_of(path).code(), ErrorCode::unsupported_format);
  fs::remove(path);
}

TEST(ImageFile, LoadsFromSeveralThreads) {
  const Raster expected = format("hibiscus_palette_alpha.png");
  std::vector<std::thread> threads;
  std::vector<Raster> loaded(4);
  for (Raster& picture : loaded) {
    threads.emplace_back([&] { picture = format("hibiscus_palette_alpha.png"); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Raster& picture : loaded) EXPECT_EQ(picture, expected);
}

}  // namespace
}  // namespace quadrille
