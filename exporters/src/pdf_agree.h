#pragma once

#include "paint_groups.h"
#include "pdf_cells.h"
#include "quadrille/patch_mesh.h"

namespace quadrille {

/// Moves the colours on the two sides of an edge that a group paints across smoothly toward each
/// other, where they differ by at most `limit` 8-bit steps: they become the same where both sides
/// are divided alike, and otherwise differ by half. Fits on the two sides of an edge mostly err
/// the same way, so that this softens facets at little cost.
void agree_at_shared_sides(const PatchMesh& patches, const PaintGroups& groups, double limit,
                           CellTable& cells);

}  // namespace quadrille
