#pragma once

#include "block_plan.h"
#include "pixel_packer.h"

namespace quadrille {

/// Paints those samples of the plan's blocks that lie in the window, of which `samples` holds the
/// first. Up to 31 floats beside what is painted, and those in up to seven rows above and below it,
/// must be there, even those that no bit asks for: they are stored to without effect, or through an
/// empty mask, which compilers may still let fault. All instruction sets give the same bits.
void paint_blocks(const BlockPlan& plan, bool opaque, const SampleWindow& window,
                  const SamplePlanes& samples);

/// The same of an opaque patch as the 8-bit pixels that a PixelPacker makes of the samples.
void paint_blocks(const BlockPlan& plan, const SampleWindow& window, const PixelWords& pixels);

}  // namespace quadrille
