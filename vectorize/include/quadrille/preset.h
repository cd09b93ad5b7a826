#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "quadrille/content.h"
#include "quadrille/vectorize.h"

namespace quadrille {

/// A named level of detail: options that suit a kind of picture at its size.
struct Preset {
  std::string name;
  std::string purpose;  ///< a few words for lists of presets
  double pixels_per_quad = 0;
  int min_quads = 0, max_quads = 0;  ///< bounds of the budget, for small and for large pictures
  /// Tears along all sharp edges, down to softer ones, so that they stay sharp at any scale, rather
  /// than where the error at the picture's own size asks for it.
  bool strong_tears = false;
};

/// draft, photo, fine, graphic, icon.
const std::vector<Preset>& presets();

/// Throws Error{invalid_argument} for a name that is none of presets().
const Preset& preset_named(std::string_view name);

/// icon for pictures up to 512 pixels a side of which 5 % or more are transparent, graphic for
/// those of which 40 % or more are flat and 128 colours or fewer make up most, else photo.
const Preset& choose_preset(const Content& content);
const Preset& choose_preset(const Raster& picture);

/// The budget for a picture of so many pixels, rounded to two significant digits: 1 quad per
/// pixels_per_quad pixels, within the preset's bounds, and at most 2 per 5 pixels.
int preset_quads(const Preset& preset, int width, int height);

/// Sets what the preset decides: the number of quads, and for strong tears where they are and
/// the fit's smoothness. Everything else stays as it is.
void apply(const Preset& preset, const Raster& picture, VectorizeOptions& options);

}  // namespace quadrille
