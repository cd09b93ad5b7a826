#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "patch_bins.h"
#include "patch_scan.h"

namespace quadrille {

/// Where a layer's picture jumps in a block of samples, all that depends on outlines only. Valid
/// for samples of `window`.
struct BlockEdges {
  /// What a patch covers of a sample's square, see OutlinePixels::Share.
  struct Share {
    std::uint8_t column, row;  ///< in the block
    float weight, x, y;
  };
  /// The shares [begin, end) of a patch.
  struct PatchShares {
    int patch;
    std::size_t begin, end;
  };

  SampleWindow window;
  std::vector<PatchShares> patches;  ///< in ascending order
  std::vector<Share> shares;
  /// Samples without a colour of their own, relative to the block: those that no patch covers, and
  /// those to which shares are added.
  std::vector<SampleSpan> blank;

  bool knows(const SampleWindow& part) const { return intersection(part, window) == part; }
  std::size_t bytes() const {
    return sizeof *this + patches.capacity() * sizeof(PatchShares) +
           shares.capacity() * sizeof(Share) + blank.capacity() * sizeof(SampleSpan);
  }
};

/// The edges of the blocks seen so far at one scale, kept from window to window. They are filled in
/// by whoever paints a block first.
class KeptEdges {
 public:
  KeptEdges() = default;
  KeptEdges(KeptEdges&&) = default;
  KeptEdges& operator=(KeptEdges&&) = default;

  void clear();
  /// Makes room for the blocks of a window; forgets others where they would take too much memory.
  void start(const SampleWindow& window);

  /// Those of the block that holds `part`, which must lie in the window. Different blocks may be
  /// used by different threads at a time.
  BlockEdges& at(const SampleWindow& part) const;

 private:
  std::unordered_map<std::uint64_t, std::unique_ptr<BlockEdges>> kept_;
  SampleWindow blocks_;               // of the window, in blocks
  std::vector<BlockEdges*> current_;  // #blocks
};

}  // namespace quadrille
