#include "block_edges.h"

namespace quadrille {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;

}  // namespace

void KeptEdges::clear() {
  current_.clear();
  kept_.clear();
}

void KeptEdges::start(const SampleWindow& window) {
  std::size_t bytes = 0;
  for (const auto& [key, edges] : kept_) bytes += edges->bytes();
  if (bytes > kMostBytes) clear();
  blocks_ = blocks_of(window);
  current_.clear();
  for (int y = blocks_.y_begin; y < blocks_.y_end; ++y) {
    for (int x = blocks_.x_begin; x < blocks_.x_end; ++x) {
      auto& edges =
          kept_[std::uint64_t{static_cast<std::uint32_t>(y)} << 32 | static_cast<std::uint32_t>(x)];
      if (!edges) edges = std::make_unique<BlockEdges>();
      current_.push_back(edges.get());
    }
  }
}

BlockEdges& KeptEdges::at(const SampleWindow& part) const {
  const SampleWindow block = blocks_of(part);
  return *current_[std::size_t{1} * (block.y_begin - blocks_.y_begin) *
                       (blocks_.x_end - blocks_.x_begin) +
                   (block.x_begin - blocks_.x_begin)];
}

}  // namespace quadrille
