#pragma once

#include "point_shader.h"

namespace quadrille {

/// Samples are cut into square blocks of this side on an absolute grid, in each of which a patch's
/// parameters are bicubic polynomials of the sample's position wherever that is exact enough.
constexpr int kParameterBlock = 16;

/// A block given by its first sample relative to the patch's whole sample, see ColorBatch.
struct ParameterBlock {
  float x, y;
};

/// A part of one row of a block.
struct BlockRow {
  int y, x, count;  ///< relative to the block
};

/// Whether interpolation at 4 x 4 Chebyshev nodes gives the parameters in each block so well that
/// no colour errs by more than 1/200 of an 8-bit step. Proven, not tried: by bounds of the
/// derivatives of the inverse. A block's answer does not depend on the others; all instruction sets
/// agree.
void judge_blocks(const PatchProgram& program, const float (&map)[6], bool opaque,
                  const ParameterBlock* blocks, int count, bool* fit);

/// Appends the parameters of parts of rows of a block that judge_blocks() found fit. False, with
/// nothing appended, where a node's parameters are not found.
bool add_block(const PatchProgram& program, const float (&map)[6], const ParameterBlock& block,
               const BlockRow* rows, int row_count, ColorBatch& batch);

}  // namespace quadrille
