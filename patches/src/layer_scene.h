#pragma once

#include <span>
#include <vector>

#include "block_edges.h"
#include "block_planner.h"
#include "patch_bins.h"
#include "patch_program.h"
#include "patch_scan.h"
#include "patch_spans.h"
#include "patch_view.h"
#include "quadrille/vector_image.h"
#include "work_arena.h"

namespace quadrille {

/// A layer prepared for drawing in a window of samples: its outlines there, and which patches each
/// block sees. Moving to another window takes one quick test of every patch and further work only
/// for patches that were not seen before at this scale.
class LayerScene {
 public:
  /// Keeps a reference to the layer. Throws Error{invalid_argument} for a transform that is not
  /// finite.
  LayerScene(const Layer& layer, WorkArena& arena);

  /// Samples per pixel of the picture along both axes, and where to draw. Throws what
  /// write_edge_polyline() throws.
  void prepare(const std::array<double, 2>& scale, const SampleWindow& window, WorkArena& arena);
  /// Makes the programs and plans of the patches in the window.
  void prepare_programs(WorkArena& arena);

  const PatchMesh& patches() const { return layer_.patches; }
  const PatchScan& scan() const { return scan_; }
  const PatchSpans& spans() const { return spans_; }
  /// What is known of the block that holds `part`; the painter of the block fills it in.
  BlockEdges& edges_at(const SampleWindow& part) const { return edges_.at(part); }
  const PatchProgram& program(int patch) const { return programs_.of(patch); }
  const PatchView& view(int patch) const { return views_[patch]; }
  /// For all samples of those patches whose spans are kept.
  const KeptPlans& plans() const { return plans_; }
  const Eigen::Affine2d& to_samples() const { return to_samples_; }
  const Eigen::Affine2d& from_samples() const { return from_samples_; }

  /// The patches that touch samples' squares of the block that holds `part`, in ascending order.
  /// The part must lie within one block and within the scene's window.
  std::span<const int> patches_at(const SampleWindow& part) const { return bins_.at(part); }

 private:
  /// Bounding box of a patch's outline's control points, in mesh coordinates.
  struct Box {
    Eigen::Array2d low, high;
  };

  const Layer& layer_;
  std::vector<Box> boxes_;  // #Q
  std::array<double, 2> scale_ = {0, 0};
  SampleWindow window_;
  Eigen::Affine2d to_samples_, from_samples_;
  std::vector<int> wanted_, unplanned_;
  PatchScan scan_;
  PatchSpans spans_;
  PatchBins bins_;
  KeptEdges edges_;
  PatchPrograms programs_;
  std::vector<PatchView> views_;  // #Q
  KeptPlans plans_;
  std::size_t plan_bytes_ = 0;
  tbb::enumerable_thread_specific<BlockPlanner> planners_;

  void find_wanted();
};

}  // namespace quadrille
