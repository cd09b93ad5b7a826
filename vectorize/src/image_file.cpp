#include "quadrille/image_file.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <system_error>

#include "color_profile.h"
#include "quadrille/error.h"
#include "vips_image.h"

namespace quadrille {
namespace fs = std::filesystem;
namespace {

/// Loaders of raster formats only: libvips could also rasterize SVG and PDF, and hand anything else
/// to ImageMagick.
constexpr const char* kLoaders[] = {"pngload_source",  "jpegload_source", "webpload_source",
                                    "tiffload_source", "gifload_source",  "heifload_source",
                                    "jp2kload_source", "jxlload_source",  "ppmload_source"};

std::string quoted(const fs::path& path) {
  std::string text("'");
  return text.append(path.string()).append("'");
}

[[noreturn]] void report_damage(const fs::path& path) {
  const std::string reason = take_vips_error();
  throw Error(ErrorCode::io_failure, quoted(path) + " is damaged or incomplete" +
                                         (reason.empty() ? "" : " (" + reason + ")") +
                                         "; use an intact copy");
}

void check_readable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    throw Error(ErrorCode::io_failure,
                quoted(path) + " cannot be read: there is no such file; check the path");
  }
  if (fs::is_directory(status)) {
    throw Error(ErrorCode::io_failure,
                quoted(path) + " cannot be read: it is a folder; name a picture in it");
  }
  if (!fs::is_regular_file(status)) {
    throw Error(ErrorCode::io_failure,
                quoted(path) + " cannot be read: it is not a regular file; name a picture file");
  }
  if (fs::file_size(path, error) == 0 && !error) {
    throw Error(ErrorCode::io_failure, quoted(path) + " is empty; use an intact copy");
  }
}

/// Reads no more than the header.
VipsImagePtr open(const fs::path& path) {
  check_readable(path);
  start_vips();
  vips_error_clear();
  const VipsSourcePtr source(vips_source_new_from_file(path.c_str()));
  if (!source) {
    throw Error(ErrorCode::io_failure,
                quoted(path) + " cannot be read: " + take_vips_error() + "; check its permissions");
  }
  const auto* loader =
      std::find_if(std::begin(kLoaders), std::end(kLoaders),
                   [&](const char* name) { return vips_foreign_is_a_source(name, source.get()); });
  vips_error_clear();
  if (loader == std::end(kLoaders)) {
    throw Error(ErrorCode::unsupported_format,
                quoted(path) +
                    " is not a PNG, JPEG, WebP, TIFF, GIF, AVIF, HEIF, JPEG 2000, JPEG XL or PPM "
                    "picture; convert it to PNG first");
  }
  VipsImagePtr image = vips_result([&](VipsImage** out) {
    return vips_call(*loader, source.get(), out, "access", VIPS_ACCESS_SEQUENTIAL, "fail_on",
                     VIPS_FAIL_ON_ERROR, nullptr);
  });
  if (!image) report_damage(path);
  return image;
}

void check_size(const VipsImage* image, const fs::path& path, const ImageLimits& limits) {
  const long long width = vips_image_get_width(image), height = vips_image_get_height(image);
  if (width * height <= limits.max_pixels) return;
  throw Error(ErrorCode::limit_exceeded,
              quoted(path) + " has " + std::to_string(width) + " x " + std::to_string(height) +
                  " pixels, more than the limit of " + std::to_string(limits.max_pixels) +
                  "; make it smaller");
}

[[noreturn]] void refuse_samples(const fs::path& path) {
  throw Error(ErrorCode::unsupported_format,
              quoted(path) +
                  " has samples other than 8 or 16 bits of gray, RGB or CMYK; convert "
                  "it to an 8-bit or 16-bit PNG first");
}

void check_samples(const VipsImage* image, const fs::path& path) {
  const VipsBandFormat format = vips_image_get_format(image);
  const bool integral = format == VIPS_FORMAT_UCHAR || format == VIPS_FORMAT_USHORT;
  if (!integral || vips_image_get_coding(image) != VIPS_CODING_NONE) refuse_samples(path);
}

/// The picture as its EXIF orientation wants it shown.
VipsImagePtr upright(VipsImagePtr image) {
  if (vips_image_get_orientation(image.get()) <= 1) return image;
  // Rotating reads the rows out of order, which a sequential loader cannot serve.
  const VipsImagePtr in_memory(vips_image_copy_memory(image.get()));
  if (!in_memory) return nullptr;
  return vips_result([&](VipsImage** out) { return vips_autorot(in_memory.get(), out, nullptr); });
}

VipsImagePtr bands(VipsImage* image, int first, int count) {
  return vips_result(
      [&](VipsImage** out) { return vips_extract_band(image, out, first, "n", count, nullptr); });
}

/// Alpha of 8 or 16 bits in the sample format of the colours, which are never narrower.
VipsImagePtr alpha_as(VipsBandFormat format, VipsImage* alpha) {
  if (vips_image_get_format(alpha) == format) return bands(alpha, 0, 1);
  const VipsImagePtr widened =
      vips_result([&](VipsImage** out) { return vips_linear1(alpha, out, 257.0, 0.0, nullptr); });
  if (!widened) return nullptr;
  return vips_result(
      [&](VipsImage** out) { return vips_cast(widened.get(), out, format, nullptr); });
}

/// Three or four bands of 8 or 16 bits, sRGB and straight alpha; null when libvips failed.
VipsImagePtr to_rgb_or_rgba(VipsImage* image) {
  const bool has_alpha = vips_image_hasalpha(image);
  const int color_bands = vips_image_get_bands(image) - (has_alpha ? 1 : 0);
  const VipsImagePtr colors = bands(image, 0, color_bands);
  if (!colors) return nullptr;
  VipsImagePtr rgb = to_srgb(colors.get());
  if (!rgb || !has_alpha) return rgb;
  const VipsImagePtr last = bands(image, color_bands, 1);
  if (!last) return nullptr;
  const VipsImagePtr alpha = alpha_as(vips_image_get_format(rgb.get()), last.get());
  if (!alpha) return nullptr;
  return vips_result(
      [&](VipsImage** out) { return vips_bandjoin2(rgb.get(), alpha.get(), out, nullptr); });
}

template <class Sample>
Raster to_raster(const Sample* samples, int width, int height, int channels, float full) {
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  bool opaque = true;
  for (std::size_t i = 0; channels == 4 && opaque && i < pixels; ++i) {
    opaque = samples[4 * i + 3] == full;
  }
  Raster picture(width, height, opaque ? 3 : 4);
  float* out = picture.data.data();
  for (std::size_t i = 0; i < pixels; ++i) {
    for (int c = 0; c < picture.channels; ++c) *out++ = samples[i * channels + c] / full;
  }
  return picture;
}

}  // namespace

Raster load_image(const fs::path& path, const ImageLimits& limits) {
  VipsImagePtr image = open(path);
  check_size(image.get(), path, limits);
  check_samples(image.get(), path);
  image = upright(std::move(image));
  if (!image) report_damage(path);
  const VipsImagePtr picture = to_rgb_or_rgba(image.get());
  const int channels = picture ? vips_image_get_bands(picture.get()) : 0;
  if (channels != 3 && channels != 4) refuse_samples(path);
  std::size_t size = 0;
  const std::unique_ptr<void, decltype(&g_free)> samples(
      vips_image_write_to_memory(picture.get(), &size), &g_free);
  if (!samples) report_damage(path);
  const int width = vips_image_get_width(picture.get());
  const int height = vips_image_get_height(picture.get());
  return vips_image_get_format(picture.get()) == VIPS_FORMAT_UCHAR
             ? to_raster(static_cast<const std::uint8_t*>(samples.get()), width, height, channels,
                         255.0f)
             : to_raster(static_cast<const std::uint16_t*>(samples.get()), width, height, channels,
                         65535.0f);
}

}  // namespace quadrille
