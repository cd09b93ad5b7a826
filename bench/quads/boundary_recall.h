#pragma once

#include <filesystem>
#include <vector>

#include "label_map.h"

namespace quadrille::bench {

/// What a segmentation's boundary achieves, and what that cost.
struct BoundaryScore {
  double recall = 0;   ///< share of the drawn pixels with a boundary pixel within the tolerance,
                       ///< mean over the annotators
  double density = 0;  ///< share of the picture's pixels that are boundary
};

/// Radius in pixels of the disk in which a boundary counts as found (paper, section 4).
inline constexpr int kRecallRadius = 2;

BoundaryScore boundary_score(const BoundaryMask& boundary,
                             const std::vector<BoundaryMask>& annotations);

/// The drawings NAME_0.png, NAME_1.png, ... of the folder, non-zero on boundaries; empty when there
/// are none. Throws Error for files that cannot be read.
std::vector<BoundaryMask> load_annotations(const std::filesystem::path& folder,
                                           const std::string& name);

}  // namespace quadrille::bench
