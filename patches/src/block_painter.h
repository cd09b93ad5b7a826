#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "block_edges.h"
#include "block_planner.h"
#include "layer_scene.h"
#include "outline_pixels.h"
#include "pixel_packer.h"
#include "point_shader.h"
#include "tile_outlines.h"

namespace quadrille {

class PatchShader;

/// Draws layers into blocks of samples; one for each thread. What a sample gets does not depend on
/// the window that it is drawn with, as long as the window lies within one block.
class BlockPainter {
 public:
  BlockPainter();

  /// Draws all layers over each other; the window must not be empty. Without alpha, which needs a
  /// single opaque layer, samples that no patch covers are black. The result is valid until the
  /// next call.
  const SamplePlanes& paint(const std::vector<LayerScene>& scenes, const SampleWindow& window,
                            bool with_alpha);

  /// Draws a single opaque layer without alpha as 8-bit pixels, the same as the packer makes of
  /// what paint() gives. The result is valid until the next call.
  PixelWords paint_words(const LayerScene& scene, const SampleWindow& window,
                         const PixelPacker& packer);

 private:
  /// Points or parameters of one patch, and where their colours go.
  struct Pending {
    ColorBatch colors;
    PointRun runs[ColorBatch::kRuns];
    int run_count = 0;
  };
  static constexpr int kWords = kBlockSide / 64;

  SampleWindow window_;
  bool with_alpha_ = true;
  bool as_words_ = false;  // interiors go to words_ instead of layer_
  std::vector<float> memory_[2];
  SamplePlanes picture_, layer_;
  std::vector<std::uint32_t> words_memory_;
  PixelWords words_;
  TileOutlines outlines_;
  std::vector<SampleSpan> spans_;
  /// A bit for each sample of a row that a patch covers.
  std::array<std::array<std::uint64_t, kWords>, kBlockSide> covered_;
  OutlinePixels outline_;
  std::vector<OutlinePixels::Share> shares_;
  std::vector<BlockEdges::Share> seen_;  // shares of one patch in the window
  std::unique_ptr<Pending> points_;
  std::vector<SampleSpan> clipped_;
  BlockPlanner planner_;
  BlockPlan plan_;  // of the current patch in the window, where none is kept

  int width() const { return window_.x_end - window_.x_begin; }
  int height() const { return window_.y_end - window_.y_begin; }
  int channels() const { return with_alpha_ ? 4 : 3; }
  void clear(SamplePlanes& planes);
  void merge_layer();
  void find_edges(const LayerScene& scene, std::span<const int> patches, BlockEdges& edges);
  void cover(std::span<const SampleSpan> spans);
  void find_blank(BlockEdges& edges);
  SampleSpan clipped(const SampleSpan& blank) const;
  void clear_blank(const BlockEdges& edges);
  void pack_blank(const BlockEdges& edges, const PixelPacker& packer);
  std::span<const SampleSpan> all_spans(const LayerScene& scene, int patch);
  std::span<const SampleSpan> clipped(std::span<const SampleSpan> spans);
  void paint_layer(const LayerScene& scene, std::span<const int> patches);
  void paint_interior(const LayerScene& scene, int patch);
  void paint_points(PatchShader& shader, std::span<const SampleSpan> spans);
  void flush(PatchShader& shader);
  /// Of the shares seen.
  void paint_outline(PatchShader& shader);
};

}  // namespace quadrille
