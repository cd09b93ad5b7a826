#pragma once

#include <vector>

#include "paint_groups.h"
#include "pdf_cells.h"

namespace quadrille {

/// A cell of a patch on its way through the group, and how it is entered.
struct CellStep {
  int i = 0, j = 0;  ///< column and row in the patch
  /// Side on which the cell is entered: 0: v low, 1: u high, 2: v high, 3: u low.
  int entry = 0;
  bool shares_entry = false;  ///< the cell before lies there, perhaps in another patch
};

/// The cells of one patch in the order in which they are written.
struct PatchVisit {
  int quad = 0;
  int entry = -1;  ///< side on which the patch before lies, or -1
  int exit = -1;   ///< side on which the next patch lies, or -1
  int start_corner = 0;
  bool rows_first = true;  ///< the cells run along u first

  std::vector<CellStep> cells(const Divisions& count) const;
};

/// Visits every patch of a group once, from neighbour to neighbour across sides that neither
/// divides for as long as there is one: cells that share a side with the one before take a third
/// fewer bytes. Patches that reach beyond their edges come first, so that whatever they should not
/// lie over is painted over them.
std::vector<PatchVisit> visit_patches(const QuadMesh& mesh, const PaintGroups& groups, int group,
                                      const CellTable& cells);

}  // namespace quadrille
