#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pdf_shading.h"
#include "pdf_underlay.h"
#include "quadrille/run_context.h"

namespace quadrille {

/// A shading and, where it is not empty, the path that it is painted inside of.
struct PaintStep {
  CoonsShading shading;
  std::string region;
};

/// A layer as PDF and PostScript paint it, in pixels of the picture, y down. Paths are made of the
/// operators m, l, c and h, in units of 1 / kPathUnits pixel.
struct PaintedLayer {
  static constexpr int kPathUnits = 32;

  CoordinateGrid grid;
  /// Lies beneath the colours, inside of its path where that is not empty.
  Underlay underlay;
  std::string underlay_region;
  std::vector<PaintStep> color;
  /// With `masked`: alpha in grays over black, and what is opaque, in white over those.
  bool masked = false;
  std::vector<PaintStep> alpha;
  std::string opaque_region;
};

/// What the writers can do with transparency.
enum class Transparency { soft_mask, over_white };

/// The layer with colours within `tolerance` (see fit_cells()). `progress` gets the completed
/// fraction. The shadings' data are in the scratch file. The same for any number of threads.
PaintedLayer paint_layer(const Layer& layer, bool fills_page, Transparency transparency,
                         double tolerance, ScratchFile& scratch, const RunContext& context,
                         const std::function<void(double)>& progress);

}  // namespace quadrille
