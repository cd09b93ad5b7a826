#include "texture_file.h"

#include <vips/vips.h>

#include <exception>
#include <memory>
#include <string>

#include "quadrille/error.h"

namespace quadrille {
namespace {

struct Unref {
  void operator()(VipsImage* image) const { g_object_unref(image); }
};
using Picture = std::unique_ptr<VipsImage, Unref>;

[[noreturn]] void fail() {
  std::string reason = vips_error_buffer();
  vips_error_clear();
  while (!reason.empty() && reason.back() == '\n') reason.pop_back();
  throw Error(ErrorCode::io_failure,
              "cannot compress the texture: " + reason + "; try fewer texels per pixel");
}

/// Keeps what the observer throws, since no exception may pass through C code.
struct Watch {
  const RunContext& context;
  std::exception_ptr failure;
};

void on_eval(VipsImage* image, VipsProgress* progress, void* data) {
  auto& watch = *static_cast<Watch*>(data);
  if (watch.failure) return;
  try {
    watch.context.progress("texture file", progress->percent / 100.0);
  } catch (...) {
    watch.failure = std::current_exception();
    vips_image_set_kill(image, TRUE);
  }
}

Picture srgb_picture(const Texture& texture) {
  static const bool started = VIPS_INIT("quadrille") == 0;
  if (!started) fail();
  const Picture samples(vips_image_new_from_memory(texture.data.data(), texture.data.size(),
                                                   texture.width, texture.height, texture.channels,
                                                   VIPS_FORMAT_UCHAR));
  if (!samples) fail();
  VipsImage* tagged = nullptr;
  if (vips_copy(samples.get(), &tagged, "interpretation", VIPS_INTERPRETATION_sRGB, nullptr)) {
    fail();
  }
  return Picture(tagged);
}

int save(VipsImage* picture, const char* ending, int quality, void** bytes, std::size_t* size) {
  if (ending == std::string(".webp")) {
    return vips_webpsave_buffer(picture, bytes, size, "Q", quality, "alpha_q", 100,
                                "smart_subsample", TRUE, "strip", TRUE, nullptr);
  }
  if (ending == std::string(".jpg")) {
    return vips_jpegsave_buffer(picture, bytes, size, "Q", quality, "optimize_coding", TRUE,
                                "subsample_mode", VIPS_FOREIGN_SUBSAMPLE_OFF, "strip", TRUE,
                                nullptr);
  }
  return vips_pngsave_buffer(picture, bytes, size, "compression", 7, "filter",
                             VIPS_FOREIGN_PNG_FILTER_ALL, "strip", TRUE, nullptr);
}

}  // namespace

EncodedTexture encode(const Texture& texture, GltfTextureFormat format, int quality,
                      const RunContext& context) {
  EncodedTexture encoded;
  if (format == GltfTextureFormat::webp) {
    encoded.mime_type = "image/webp";
    encoded.ending = ".webp";
  } else if (format == GltfTextureFormat::jpeg && texture.channels == 3) {
    encoded.mime_type = "image/jpeg";
    encoded.ending = ".jpg";
  }
  const Picture picture = srgb_picture(texture);
  Watch watch{context, nullptr};
  vips_image_set_progress(picture.get(), TRUE);
  g_signal_connect(picture.get(), "eval", G_CALLBACK(on_eval), &watch);
  void* bytes = nullptr;
  std::size_t size = 0;
  const int status = save(picture.get(), encoded.ending, quality, &bytes, &size);
  const std::unique_ptr<void, decltype(&g_free)> owner(bytes, g_free);
  if (watch.failure) {
    vips_error_clear();
    std::rethrow_exception(watch.failure);
  }
  if (status != 0) fail();
  const auto* begin = static_cast<const std::uint8_t*>(bytes);
  encoded.bytes.assign(begin, begin + size);
  return encoded;
}

}  // namespace quadrille
