#include "patch_bins.h"

namespace quadrille {
namespace {

int floor_block(int sample) {
  return sample >= 0 ? sample / kBlockSide : -((kBlockSide - 1 - sample) / kBlockSide);
}

}  // namespace

SampleWindow blocks_of(const SampleWindow& window) {
  return {floor_block(window.x_begin), floor_block(window.y_begin),
          floor_block(window.x_end - 1) + 1, floor_block(window.y_end - 1) + 1};
}

void PatchBins::fill(const PatchScan& scan, std::span<const int> wanted,
                     const SampleWindow& window) {
  blocks_ = blocks_of(window);
  const auto for_each_block = [&](const auto& visit) {
    for (const int q : wanted) {
      const SampleWindow s = scan.touched(q);
      const SampleWindow b = intersection({floor_block(s.x_begin), floor_block(s.y_begin),
                                           floor_block(s.x_end) + 1, floor_block(s.y_end) + 1},
                                          blocks_);
      for (int y = b.y_begin; y < b.y_end; ++y) {
        for (int x = b.x_begin; x < b.x_end; ++x) {
          visit(q, (y - blocks_.y_begin) * columns() + (x - blocks_.x_begin));
        }
      }
    }
  };
  begin_.assign(columns() * (blocks_.y_end - blocks_.y_begin) + 1, 0);
  for_each_block([&](int, std::size_t block) { ++begin_[block + 1]; });
  for (std::size_t b = 1; b < begin_.size(); ++b) begin_[b] += begin_[b - 1];
  patches_.resize(begin_.back());
  next_.assign(begin_.begin(), begin_.end() - 1);
  for_each_block([&](int q, std::size_t block) { patches_[next_[block]++] = q; });
}

std::span<const int> PatchBins::at(const SampleWindow& part) const {
  const std::size_t block = (floor_block(part.y_begin) - blocks_.y_begin) * columns() +
                            (floor_block(part.x_begin) - blocks_.x_begin);
  return {patches_.data() + begin_[block], patches_.data() + begin_[block + 1]};
}

}  // namespace quadrille
