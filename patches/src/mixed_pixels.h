#pragma once

#include <vector>

#include "patch_scan.h"
#include "quadrille/raster.h"
#include "wedge_rows.h"

namespace quadrille {

/// The least-squares equations of the pixels that a tear crosses, or the border of the mesh inside
/// the picture. The renderer mixes them from the patches that they show (see render()), so each is
/// one equation over the unknowns of several patches: sum over its patches of covered share *
/// colour at the share's centroid = the pixel's colour. Where the mesh covers only a part of the
/// pixel, that part has the pixel's colour.
class MixedPixels {
 public:
  /// Finds the pixels and adds their equations to `rows`, which is empty. None when the mesh has no
  /// tears and fills the picture. The scan has one sample per pixel.
  MixedPixels(const PatchScan& scan, const Raster& picture, WedgeRows& rows);

  /// The pixels, y * width + x, in the order of their rows.
  const std::vector<std::size_t>& pixels() const { return pixels_; }
  /// True for the pixels that have an equation here, which leave none to point samples.
  bool contains(std::size_t pixel) const { return !is_mixed_.empty() && is_mixed_[pixel]; }
  /// How many pixels' worth of the patch's colour its mixtures leave open: the sum of w (1 - w)
  /// over its shares w.
  double open_area(int patch) const { return open_area_.empty() ? 0 : open_area_[patch]; }

 private:
  std::vector<std::size_t> pixels_;
  std::vector<char> is_mixed_;     // #pixels of the picture; empty for none
  std::vector<double> open_area_;  // #Q; empty for none
};

}  // namespace quadrille
