#pragma once

#include "document_quantization.h"
#include "document_range_coder.h"

namespace quadrille {

/// Codes the wedges' colours: first the values of all wedges, each predicted from those before it,
/// then gradients, predicted from all values, then twists, predicted from values and gradients.
/// Predictions are linear; their weights are the best ones for these patches and are stored. They
/// are computed in doubles by operations that every IEEE machine rounds alike, in a fixed order.
/// Mesh, shapes and wedge_of_corner are known to both sides.
void encode_colors(RangeEncoder& coder, const QuantizedPatches& patches, const PositionGrid& grid,
                   double color_step);
void decode_colors(RangeDecoder& coder, QuantizedPatches& patches, const PositionGrid& grid,
                   double color_step);

}  // namespace quadrille
