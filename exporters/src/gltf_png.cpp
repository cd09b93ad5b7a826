#include <vips/vips.h>

#include <memory>
#include <string>

#include "gltf_texture.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

[[noreturn]] void fail() {
  std::string reason = vips_error_buffer();
  vips_error_clear();
  while (!reason.empty() && reason.back() == '\n') reason.pop_back();
  throw Error(ErrorCode::io_failure,
              "cannot compress the texture: " + reason + "; try fewer texels per pixel");
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Texture& texture) {
  static const bool started = VIPS_INIT("quadrille") == 0;
  if (!started) fail();
  const auto release = [](VipsImage* image) { g_object_unref(image); };
  const std::unique_ptr<VipsImage, decltype(release)> samples(
      vips_image_new_from_memory(texture.data.data(), texture.data.size(), texture.width,
                                 texture.height, texture.channels, VIPS_FORMAT_UCHAR),
      release);
  if (!samples) fail();
  VipsImage* tagged = nullptr;
  if (vips_copy(samples.get(), &tagged, "interpretation", VIPS_INTERPRETATION_sRGB, nullptr)) {
    fail();
  }
  const std::unique_ptr<VipsImage, decltype(release)> picture(tagged, release);
  void* bytes = nullptr;
  std::size_t size = 0;
  if (vips_pngsave_buffer(picture.get(), &bytes, &size, "compression", 4, "filter",
                          VIPS_FOREIGN_PNG_FILTER_PAETH, "strip", TRUE, nullptr)) {
    fail();
  }
  const std::unique_ptr<void, decltype(&g_free)> owner(bytes, g_free);
  const auto* begin = static_cast<const std::uint8_t*>(bytes);
  return {begin, begin + size};
}

}  // namespace quadrille
