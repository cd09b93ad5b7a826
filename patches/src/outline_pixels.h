#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "patch_bins.h"
#include "patch_scan.h"

namespace quadrille {

/// The samples of a window whose squares an outline crosses: edges on the border of the mesh, and
/// tears. Lines that run exactly between samples cross none.
class OutlinePixels {
 public:
  /// Samples are divided kDivision x kDivision times for measuring coverage.
  static constexpr int kDivisionBits = 4;
  static constexpr int kDivision = 1 << kDivisionBits;

  struct Pixel {
    int x, y;
    /// Sub-samples taken by patches so far, a bit per column, a word per row.
    std::array<std::uint16_t, kDivision> taken = {};
  };

  /// What one patch covers of one pixel beyond what patches before it took.
  struct Share {
    int pixel;     ///< index into pixels()
    float weight;  ///< covered part of the pixel's area, in (0, 1]
    float x, y;    ///< centroid of the covered sub-samples relative to the pixel's corner, samples
  };

  /// Finds the crossed samples of the window, which must not be larger than a block.
  void find(const PatchScan& scan, std::span<const int> patches, const SampleWindow& window);

  const std::vector<Pixel>& pixels() const { return pixels_; }

  /// Takes what the patch covers of the free sub-samples of all pixels; call in ascending order of
  /// patches. The list replaces `shares`.
  void take(const PatchScan& scan, int patch, std::vector<Share>& shares);

 private:
  struct Sum {
    int count, x, y;
  };
  /// The columns of the window where a row has pixels: their range, and a bit for each.
  struct Row {
    int begin, end;
    std::array<std::uint64_t, kBlockSide / 64> bits;
  };

  SampleWindow window_;
  std::vector<Pixel> pixels_;
  std::vector<int> index_;  // #samples of the window; -1 where not crossed
  std::vector<Sum> sums_;   // #pixels, of the current patch
  std::vector<int> touched_;
  std::vector<SampleSpan> spans_;
  std::vector<Row> rows_;

  int width() const { return window_.x_end - window_.x_begin; }
  void mark_segment(const FixedPoint& a, const FixedPoint& b);
  void mark(int x, int y);
  SampleWindow crossed_part(const SampleWindow& bounds) const;
};

}  // namespace quadrille
