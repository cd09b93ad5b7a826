#pragma once

#include "document_quantization.h"
#include "document_range_coder.h"

namespace quadrille {

/// Codes positions, edge flags and edge shapes of patches whose mesh is in the order of
/// encode_connectivity(). The decoders fill in what the encoders read; the mesh's connectivity is
/// known to both.
void encode_geometry(RangeEncoder& coder, const QuantizedPatches& patches,
                     const PositionGrid& grid);
void decode_geometry(RangeDecoder& coder, QuantizedPatches& patches, const PositionGrid& grid);

}  // namespace quadrille
