#pragma once

#include <cstdint>
#include <vector>

#include "patch_scan.h"
#include "quadrille/raster.h"

namespace quadrille {

/// Patches whose samples are kept together; also the unit of parallel work on samples.
inline constexpr int kSampleBlock = 64;

inline int sample_block_count(const PatchMesh& patches) {
  return (patches.patch_count() + kSampleBlock - 1) / kSampleBlock;
}

/// Where a block of patches is compared with a picture: at the pixel centres that each patch
/// covers.
struct SampleBlock {
  /// A sample that is not compared with its pixel's colour but with this premultiplied one.
  struct Exception {
    std::size_t sample;
    Color color;
  };

  int first_patch = 0;
  std::vector<std::size_t> begin;     ///< of the patches' samples; one more than patches
  std::vector<float> u, v;            ///< parameters, in [0, 1]
  std::vector<std::uint32_t> pixel;   ///< y * width + x
  std::vector<Exception> exceptions;  ///< ascending

  int patch_count() const { return static_cast<int>(begin.size()) - 1; }
};

/// Block number `block`. The scan has one sample per pixel of the picture.
SampleBlock find_samples(const PatchMesh& patches, const PatchScan& scan, const Raster& picture,
                         int block);

}  // namespace quadrille
