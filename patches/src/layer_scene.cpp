#include "layer_scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "patch_shader.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

constexpr std::size_t kRange = 512;            // patches worked on at a time
constexpr std::size_t kMostPoints = 1u << 22;  // of outlines that are kept, 16 bytes each
constexpr std::size_t kMostSpans = 1u << 22;   // 12 bytes each
constexpr std::size_t kMostPlanBytes = std::size_t{192} << 20;

}  // namespace

LayerScene::LayerScene(const Layer& layer, WorkArena& arena)
    : layer_(layer), boxes_(layer.patches.patch_count()), scan_(layer.patches) {
  if (!layer.transform.matrix().allFinite()) {
    throw Error(ErrorCode::invalid_argument, "the transform of layer '" + layer.name +
                                                 "' is not finite; give it finite numbers");
  }
  arena.for_each((boxes_.size() + kRange - 1) / kRange, [&](std::size_t r) {
    const PatchMesh& patches = layer.patches;
    const int end = static_cast<int>(std::min(boxes_.size(), (r + 1) * kRange));
    for (int q = static_cast<int>(r * kRange); q < end; ++q) {
      Eigen::Array2d low(INFINITY, INFINITY), high = -low;
      for (int k = 0; k < 4; ++k) {
        const int h = 4 * q + k;
        const Eigen::Array2d ends[2] = {patches.mesh.vertices[patches.mesh.origin(h)],
                                        patches.mesh.vertices[patches.mesh.tip(h)]};
        for (const Eigen::Array2d& p :
             {ends[0], Eigen::Array2d(ends[0] + tangent_along(patches, h, 0).array() / 3),
              Eigen::Array2d(ends[1] - tangent_along(patches, h, 1).array() / 3)}) {
          low = low.min(p), high = high.max(p);
          if (!p.isFinite().all()) low.setConstant(NAN);
        }
        if (!low.isFinite().all()) break;
      }
      boxes_[q] = {low, high};
    }
  });
}

/// Patches whose control points' bounding box meets the window. A map without an inverse leaves
/// nothing to see.
void LayerScene::find_wanted() {
  wanted_.clear();
  if (to_samples_.linear().determinant() == 0) return;
  // Bounds of the mapped box: its middle, and half its size times the map's absolute values.
  const Eigen::Matrix2d spread = to_samples_.linear().cwiseAbs();
  const Eigen::Array2d window_low(window_.x_begin - 1, window_.y_begin - 1);
  const Eigen::Array2d window_high(window_.x_end + 1, window_.y_end + 1);
  for (int q = 0; q < static_cast<int>(boxes_.size()); ++q) {
    const Box& box = boxes_[q];
    const Eigen::Array2d middle = to_samples_ * ((box.low + box.high) / 2).matrix();
    const Eigen::Array2d reach = spread * ((box.high - box.low) / 2).matrix();
    // Written so that numbers that are not finite stay in and are reported.
    const bool outside =
        (middle + reach < window_low).any() || (middle - reach > window_high).any();
    if (!outside) wanted_.push_back(q);
  }
}

void LayerScene::prepare(const std::array<double, 2>& scale, const SampleWindow& window,
                         WorkArena& arena) {
  if (scale == scale_ && window == window_) return;
  if (scale != scale_ || scan_.point_count() > kMostPoints || spans_.span_count() > kMostSpans ||
      plan_bytes_ > kMostPlanBytes) {
    scale_ = {0, 0};  // until everything is done
    to_samples_ = Eigen::Scaling(scale[0], scale[1]) * layer_.transform;
    from_samples_ = to_samples_.inverse();
    scan_.start(to_samples_);
    spans_.start(boxes_.size());
    edges_.clear();
    plans_.start(boxes_.size());
    plan_bytes_ = 0;
    views_.assign(boxes_.size(), {});
  }
  window_ = window;
  find_wanted();
  scale_ = {0, 0};
  const auto for_each = [&](std::size_t count, const auto& body) { arena.for_each(count, body); };
  scan_.add(wanted_, for_each);
  spans_.add(scan_, wanted_, for_each);
  bins_.fill(scan_, wanted_, window);
  edges_.start(window);
  scale_ = scale;
}

void LayerScene::prepare_programs(WorkArena& arena) {
  programs_.add(layer_.patches, wanted_,
                [&](std::size_t count, const auto& body) { arena.for_each(count, body); });
  for (const int q : wanted_) {
    if (!views_[q].known) views_[q] = PatchView(program(q), to_samples_, from_samples_);
  }
  unplanned_.clear();
  std::ranges::copy_if(wanted_, std::back_inserter(unplanned_),
                       [&](int q) { return spans_.has(q) && !plans_.has(q); });
  constexpr std::size_t kPlanned = 64;
  arena.for_each((unplanned_.size() + kPlanned - 1) / kPlanned, [&](std::size_t r) {
    BlockPlanner& planner = planners_.local();
    BlockPlan plan;
    const std::size_t end = std::min(unplanned_.size(), (r + 1) * kPlanned);
    for (std::size_t i = r * kPlanned; i < end; ++i) {
      const int q = unplanned_[i];
      PatchShader shader(*this, q);
      planner.plan(shader, scan_.bounds(q), spans_.of(q), true, plan);
      plans_.set(q, plan);
    }
  });
  for (const int q : unplanned_) plan_bytes_ += plans_.of(q).bytes();
}

}  // namespace quadrille
