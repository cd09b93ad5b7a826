#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "quadrille/render.h"
#include "quadrille/run_context.h"
#include "sheeted_layer.h"

namespace quadrille {

/// 8-bit samples, interleaved RGB or RGBA with straight alpha, rows from the top.
struct Texture {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<std::uint8_t> data;
};

/// How much of what a sheet shows can be seen through.
enum class AlphaMode { opaque, mask, blend };

struct SheetTexture {
  Texture texture;
  AlphaMode alpha_mode = AlphaMode::opaque;
  /// Per texel whether the sheet's patches touch it or lie within a few texels: what is filled
  /// farther off says nothing about the picture. Empty for opaque ones.
  std::vector<std::uint8_t> is_near;
  /// The part of the picture that the texture shows, in texels from the picture's top left, and the
  /// texels of the whole picture.
  PixelRegion region;
  int picture_width = 0, picture_height = 0;
};

/// Longest side of a texture; what practically every graphics processor accepts.
inline constexpr int kMaxTextureSide = 8192;

/// One sheet of a layer, drawn over the whole picture's rectangle (the first sheet) or over that of
/// its patches. The geometry does the clipping, so alpha is the paint's own, without the coverage
/// of outline and tears, and paint goes on past them: texels that none of the sheet's patches
/// touches, and the colour of transparent ones, are filled from their surroundings. RGB when
/// everything that the patches show is opaque.
SheetTexture sheet_texture(const VectorImage& image, const SheetedLayer& layer, int sheet,
                           double texels_per_pixel, const RunContext& context);

/// Replaces the channels [first, first + count) of every texel that is not known: within four
/// texels of known ones by what is next to them, farther off by the mean of known texels in its
/// surroundings. `known` has one entry per texel. Does nothing when none is known. Returns `known`
/// with the texels within four.
std::vector<std::uint8_t> fill_unknown(Texture& texture, int first, int count,
                                       std::vector<std::uint8_t> known);

}  // namespace quadrille
