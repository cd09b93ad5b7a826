#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pdf_shading.h"
#include "pdf_underlay.h"
#include "quadrille/run_context.h"

namespace quadrille {

/// A shading and, where it is not empty, the path that it is painted inside of. Lines one pixel of
/// the device wide, half of it inside, then add to that region or take away from it.
struct PaintStep {
  CoonsShading shading;
  std::string region, growing, shrinking;
};

/// Patches that one mask cuts off together: colours over an image of them that lies beneath.
struct PaintedPart {
  Underlay underlay;
  std::vector<PaintStep> color;
  /// Where not empty, the part shows through these, alpha in grays over black.
  std::vector<PaintStep> alpha;
  /// Where not empty, the path that the part is painted inside of.
  std::string region;
};

/// A layer as PDF and PostScript paint it, in pixels of the picture, y down: parts one over
/// another. Paths are made of the operators m, l, c and h, in units of 1 / kPathUnits pixel.
///
/// What is translucent lies beneath what is opaque and reaches below its outline. A pixel that both
/// share then weights their colours by their alpha; of one mask for both, it would get their
/// unweighted mean, in which the colours of what hardly shows are seen.
struct PaintedLayer {
  static constexpr int kPathUnits = 32;

  CoordinateGrid grid;
  std::vector<PaintedPart> parts;
};

/// What the writers can do with transparency.
enum class Transparency { soft_mask, over_white };

/// The layer with colours within `tolerance` (see fit_cells()). `progress` gets the completed
/// fraction. The shadings' data are in the scratch file. The same for any number of threads.
PaintedLayer paint_layer(const Layer& layer, bool fills_page, Transparency transparency,
                         double tolerance, ScratchFile& scratch, const RunContext& context,
                         const std::function<void(double)>& progress);

}  // namespace quadrille
