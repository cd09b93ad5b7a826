#pragma once

#include <cstdint>
#include <span>

#include "patch_program.h"
#include "patch_scan.h"
#include "pixel_packer.h"

namespace quadrille {

/// Samples are cut into square blocks on absolute grids, in each of which a patch's colours are
/// bicubic polynomials of the sample's position wherever that is exact enough.
constexpr int kBlockSides[] = {32, 16, 8};

/// A block's first sample relative to the patch's whole sample, see ColorBatch.
struct ColorBlock {
  float x, y;
};

/// Whether interpolation at 4 x 4 Chebyshev nodes gives the colours in each block of side `side` to
/// 1/130 of an 8-bit step. Proven, not tried: by bounds of the derivatives of the inverse and of
/// the colours. A block's answer does not depend on the others; all instruction sets agree.
void judge_blocks(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                  std::span<const ColorBlock> blocks, std::uint8_t* fit);

/// A block's first sample, spans that may reach into it, and the samples of a window, outside of
/// which nothing is painted.
struct BlockTarget {
  int left, top;
  std::span<const SampleSpan> spans;
  const SampleWindow& window;
  const SamplePlanes& samples;  ///< whole rows of the block are read and written again
};

/// A patch's colours at the 4 x 4 nodes of a block before clamping, [channel][4 row + column].
using BlockNodes = float[4][16];

/// False where a node's parameters are not found.
bool find_block_nodes(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                      const ColorBlock& block, BlockNodes& nodes);

/// Paints those parts of the spans that lie in the block.
void paint_block(const BlockNodes& nodes, bool opaque, int side, const BlockTarget& target);

}  // namespace quadrille
