#pragma once

#include <cstdint>
#include <span>

#include "block_plan.h"
#include "patch_program.h"

namespace quadrille {

/// A block's first sample relative to the patch's whole sample, see ColorBatch.
struct ColorBlock {
  float x, y;
};

/// Whether interpolation at 4 x 4 Chebyshev nodes gives the colours in each block of side `side` to
/// 1/130 of an 8-bit step. Proven, not tried: by bounds of the derivatives of the inverse and of
/// the colours. A block's answer does not depend on the others; all instruction sets agree.
void judge_blocks(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                  std::span<const ColorBlock> blocks, std::uint8_t* fit);

/// The polynomials through a patch's colours at a block's 4 x 4 nodes, before clamping, as
/// BlockPlan::series has them. False where a node's parameters are not found.
bool find_block_series(const PatchProgram& program, const float (&map)[6], bool opaque, int side,
                       const ColorBlock& block, float* series);

/// Whether the polynomials of a block of side 8 differ by at most 1/170 of an 8-bit step from the
/// colours by Newton's method at the `samples`, a bit for each, row by row: by less than 1/100 from
/// the truth then. All instruction sets agree.
bool block_matches(const PatchProgram& program, const float (&map)[6], bool opaque,
                   const ColorBlock& block, const float* series, std::uint64_t samples);

}  // namespace quadrille
