#pragma once

#include <span>
#include <vector>

#include "patch_bins.h"
#include "patch_scan.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// A layer prepared for scanning in a window of samples: its outlines there, and which patches each
/// block sees. Takes one quick test of every patch and further work only for those in the window.
class LayerScene {
 public:
  /// Keeps a reference to the layer. Throws what append_edge_polyline throws.
  LayerScene(const Layer& layer, const std::array<double, 2>& scale, const SampleWindow& window);

  const PatchMesh& patches() const { return layer_.patches; }
  const PatchScan& scan() const { return scan_; }
  const Eigen::Affine2d& to_samples() const { return to_samples_; }
  const Eigen::Affine2d& from_samples() const { return from_samples_; }

  /// The patches that touch samples' squares of the block that holds `part`, in ascending order.
  /// The part must lie within one block and within the scene's window.
  std::span<const int> patches_at(const SampleWindow& part) const { return bins_.at(part); }

 private:
  const Layer& layer_;
  Eigen::Affine2d to_samples_, from_samples_;
  std::vector<int> wanted_;
  PatchScan scan_;
  PatchBins bins_;
};

}  // namespace quadrille
