#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "block_colors.h"
#include "block_edges.h"
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

 private:
  /// Points or parameters of one patch, and where their colours go.
  struct Pending {
    ColorBatch colors;
    PointRun runs[ColorBatch::kRuns];
    int run_count = 0;
  };
  static constexpr int kWords = kBlockSide / 64;
  static constexpr int kSmallest = kBlockSides[2];
  static constexpr int kBlocks = kBlockSide / kSmallest;  // in a row of a block of samples

  /// The spans of some rows and the range of columns that they reach into.
  struct Band {
    int begin, end, x_begin, x_end;
  };
  /// The first sample of a block of colours.
  struct Corner {
    int x, y;
  };

  SampleWindow window_;
  bool with_alpha_ = true;
  std::vector<float> memory_[2];
  SamplePlanes picture_, layer_;
  TileOutlines outlines_;
  std::vector<SampleSpan> spans_;
  /// A bit for each sample of a row that a patch covers.
  std::array<std::array<std::uint64_t, kWords>, kBlockSide> covered_;
  OutlinePixels outline_;
  std::vector<OutlinePixels::Share> shares_;
  std::vector<BlockEdges::Share> seen_;  // shares of one patch in the window
  std::unique_ptr<Pending> points_;
  std::array<Band, kBlocks> bands_;
  std::vector<SampleSpan> rest_;
  std::vector<Corner> tried_;       // blocks of the current patch
  std::vector<ColorBlock> blocks_;  // those tried, and their rows
  std::vector<std::span<const SampleSpan>> inside_;

  int width() const { return window_.x_end - window_.x_begin; }
  int height() const { return window_.y_end - window_.y_begin; }
  int channels() const { return with_alpha_ ? 4 : 3; }
  void clear(SamplePlanes& planes);
  void merge_layer();
  void find_edges(const LayerScene& scene, std::span<const int> patches, BlockEdges& edges);
  void cover();
  void find_blank(BlockEdges& edges);
  void clear_blank(const BlockEdges& edges);
  void find_spans(const LayerScene& scene, int patch);
  void paint_layer(const LayerScene& scene, std::span<const int> patches);
  /// Of the spans found in the window.
  void paint_interior(const LayerScene& scene, int patch);
  void paint_points(PatchShader& shader, std::span<const SampleSpan> spans);
  void paint_blocks(PatchShader& shader, const SampleWindow& part, int largest);
  void find_bands();
  void paint_fitting(PatchShader& shader, int side);
  void paint_rest(PatchShader& shader);
  std::span<const SampleSpan> spans_in(int x, int y, int side) const;
  void flush(PatchShader& shader);
  /// Of the shares seen.
  void paint_outline(PatchShader& shader);
};

}  // namespace quadrille
