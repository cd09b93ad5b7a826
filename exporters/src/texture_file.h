#pragma once

#include "quadrille/export.h"
#include "sheet_texture.h"

namespace quadrille {

/// The texture as a file of the format; with alpha, PNG instead of JPEG. Throws Error{io_failure},
/// and Error{cancelled} when the context asks to stop.
struct EncodedTexture {
  std::vector<std::uint8_t> bytes;
  const char* mime_type = "image/png";
  const char* ending = ".png";
};
/// `quality` is that of WebP and JPEG, 1 to 100.
EncodedTexture encode(const Texture& texture, GltfTextureFormat format, int quality,
                      const RunContext& context);

}  // namespace quadrille
