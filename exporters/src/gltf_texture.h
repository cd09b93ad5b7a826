#pragma once

#include <cstdint>
#include <vector>

#include "quadrille/run_context.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// 8-bit samples, interleaved RGB or RGBA with straight alpha, rows from the top.
struct Texture {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<std::uint8_t> data;
};

/// Longest side of a texture; what practically every graphics processor accepts.
inline constexpr int kMaxTextureSide = 8192;

/// One layer alone, drawn over the whole picture's rectangle. The geometry does the clipping, so
/// alpha is the paint's own, without the coverage of the outline, and paint goes on past the
/// outline. Fully transparent texels take the colour of their surroundings: bilinear filtering
/// then shows no dark halo. RGB when the layer's patches are opaque.
Texture layer_texture(const VectorImage& image, const Layer& layer, double texels_per_pixel,
                      const RunContext& context);

/// Replaces the channels [first, first + count) of every texel that is not known by the mean of
/// known texels in its surroundings; `known` has one entry per texel. Does nothing when none is
/// known.
void fill_unknown(Texture& texture, int first, int count, const std::vector<std::uint8_t>& known);

/// The texture as a PNG file. Throws Error{io_failure}.
std::vector<std::uint8_t> encode_png(const Texture& texture);

}  // namespace quadrille
