#pragma once

#include <span>
#include <vector>

#include "patch_scan.h"

namespace quadrille {

/// Samples are worked on in square blocks of this side on an absolute grid, so that whatever is
/// computed per block does not depend on the region drawn.
constexpr int kBlockSide = 128;

/// The blocks that a window of samples reaches into.
SampleWindow blocks_of(const SampleWindow& window);

/// Which patches each block of a window of samples sees.
class PatchBins {
 public:
  /// Sorts the patches `wanted`, given in ascending order; keeps memory from time to time.
  void fill(const PatchScan& scan, std::span<const int> wanted, const SampleWindow& window);

  /// The patches that touch samples' squares of the block that holds `part`, in ascending order.
  /// The part must lie within one block and within the window.
  std::span<const int> at(const SampleWindow& part) const;

 private:
  SampleWindow blocks_;             // of the window, in blocks
  std::vector<std::size_t> begin_;  // #blocks + 1
  std::vector<std::size_t> next_;   // #blocks
  std::vector<int> patches_;

  std::size_t columns() const { return blocks_.x_end - blocks_.x_begin; }
};

}  // namespace quadrille
