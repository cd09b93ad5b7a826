#include "fit/jpeg.h"

#include <vips/vips.h>

#include <memory>
#include <vector>

#include "fit/on_white.h"
#include "quadrille/error.h"
#include "quadrille/metrics.h"

namespace quadrille::bench {
namespace {

struct Unref {
  void operator()(VipsImage* image) const { g_object_unref(image); }
};
using Image = std::unique_ptr<VipsImage, Unref>;
using Bytes = std::vector<unsigned char>;

/// Takes over what a libvips call has made.
Image checked(VipsImage* image) {
  if (!image) throw Error(ErrorCode::io_failure, vips_error_buffer());
  return Image(image);
}

Bytes encoded(Bytes& pixels, int width, int height, int quality) {
  const Image image = checked(vips_image_new_from_memory(pixels.data(), pixels.size(), width,
                                                         height, 3, VIPS_FORMAT_UCHAR));
  image->Type = VIPS_INTERPRETATION_sRGB;
  void* buffer = nullptr;
  std::size_t size = 0;
  if (vips_jpegsave_buffer(image.get(), &buffer, &size, "Q", quality, "optimize_coding", TRUE,
                           "strip", TRUE, nullptr) != 0) {
    throw Error(ErrorCode::io_failure, vips_error_buffer());
  }
  const auto* first = static_cast<unsigned char*>(buffer);
  Bytes file(first, first + size);
  g_free(buffer);
  return file;
}

Raster decoded(const Bytes& file) {
  VipsImage* opened = nullptr;
  vips_jpegload_buffer(const_cast<unsigned char*>(file.data()), file.size(), &opened, nullptr);
  const Image image = checked(opened);
  std::size_t size = 0;
  void* const memory = vips_image_write_to_memory(image.get(), &size);
  if (!memory) throw Error(ErrorCode::io_failure, vips_error_buffer());
  Raster result(image->Xsize, image->Ysize, 3);
  const auto* samples = static_cast<unsigned char*>(memory);
  for (std::size_t i = 0; i < result.data.size(); ++i) result.data[i] = samples[i] / 255.0f;
  g_free(memory);
  return result;
}

}  // namespace

nlohmann::ordered_json jpeg_within(const Raster& picture, std::size_t bytes) {
  if (VIPS_INIT("bench_fit") != 0) throw Error(ErrorCode::io_failure, vips_error_buffer());
  const Raster shown = on_white(picture);
  Bytes pixels;
  for (const float sample : shown.data) {
    pixels.push_back(static_cast<unsigned char>(sample * 255 + 0.5f));
  }
  Bytes best;
  int below = 0, above = 101;  // qualities that fit and do not
  while (above - below > 1) {
    const int quality = (below + above) / 2;
    Bytes file = encoded(pixels, shown.width, shown.height, quality);
    if (file.size() <= bytes) {
      below = quality;
      best = std::move(file);
    } else {
      above = quality;
    }
  }
  if (best.empty()) return nlohmann::ordered_json::object();
  const ImageDifference difference = compare(shown, decoded(best));
  return {{"quality", below},
          {"bytes", best.size()},
          {"mae", difference.mae},
          {"psnr", difference.psnr},
          {"ssim", difference.ssim}};
}

}  // namespace quadrille::bench
