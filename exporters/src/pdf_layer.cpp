#include "pdf_layer.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "arena_size.h"
#include "paintable_patch.h"
#include "patch_opacity.h"
#include "pdf_agree.h"
#include "pdf_region_path.h"

namespace quadrille {
namespace {

/// Patches that are fitted together; bounds the memory.
constexpr int kChunk = 512;

class LayerPainter {
 public:
  LayerPainter(const Layer& layer, double tolerance, ScratchFile& scratch,
               const RunContext& context, const std::function<void(double)>& progress)
      : layer_(layer),
        tolerance_(tolerance),
        scratch_(scratch),
        arena_(arena_size(context)),
        progress_(progress),
        paintable_(paintable_patches(layer)),
        opacity_(paint_opacities(layer.patches, 0.5 * tolerance / 255, paintable_)) {}

  PaintedLayer run(bool fills_page, Transparency transparency) {
    const QuadMesh& mesh = layer_.patches.mesh;
    PaintedLayer painted;
    const Eigen::AlignedBox2d box = bounds();
    painted.grid = grid_ = CoordinateGrid::covering(with_margin(box));
    painted.masked = transparency == Transparency::soft_mask && !all(PatchOpacity::opaque);

    PaintGroups groups = paint_groups(mesh, where_not(PatchOpacity::transparent), paintable_);
    groups.open_border = fills_page || painted.masked;
    groups.open_unpainted = painted.masked;
    jobs_ = painted.masked ? 2 : 1;
    const bool flatten = transparency == Transparency::over_white;
    const auto quantity = flatten ? ShadedQuantity::over_white : ShadedQuantity::color;
    const CellTable cells = fitted(groups, groups.count, quantity);
    painted.underlay = underlay(layer_, cells, box);
    if (!fills_page && !painted.masked) {
      painted.underlay_region = region(border_of(mesh, where_not(PatchOpacity::transparent)));
    }
    painted.color = steps(groups, groups.count, quantity, cells);
    if (painted.masked) paint_alpha(painted, fills_page);
    return painted;
  }

 private:
  /// What is opaque needs no shading: its outline filled says the same, sharply.
  void paint_alpha(PaintedLayer& painted, bool fills_page) {
    const QuadMesh& mesh = layer_.patches.mesh;
    std::vector<char> opaque(opacity_.size()), translucent(opacity_.size());
    for (std::size_t q = 0; q < opacity_.size(); ++q) {
      opaque[q] = opacity_[q] == PatchOpacity::opaque;
      translucent[q] = opacity_[q] == PatchOpacity::translucent;
    }
    PaintGroups groups = paint_groups(mesh, translucent, paintable_);
    groups.open_border = fills_page;
    for (std::size_t q = 0; q < opacity_.size(); ++q) {
      if (opaque[q]) groups.group[q] = groups.count;
    }
    painted.alpha = steps(groups, groups.count, ShadedQuantity::alpha,
                          fitted(groups, groups.count, ShadedQuantity::alpha));
    painted.opaque_region = region(border_of(mesh, opaque));
  }

  std::vector<PaintStep> steps(const PaintGroups& groups, int count, ShadedQuantity quantity,
                               const CellTable& cells) {
    const QuadMesh& mesh = layer_.patches.mesh;
    std::vector<PaintStep> all;
    for (int g = 0; g < count; ++g) {
      const auto visits = visit_patches(mesh, groups, g, cells);
      const auto share = [&](double part) { report(0.5 + 0.5 * (g + part) / count); };
      all.push_back({coons_shading(layer_, groups, visits, cells, grid_, quantity, scratch_, share),
                     region(group_region(mesh, groups, g))});
    }
    ++jobs_done_;
    return all;
  }

  std::string region(const std::vector<EdgeLoop>& loops) const {
    return region_path(layer_, loops, PaintedLayer::kPathUnits);
  }

  CellTable fitted(const PaintGroups& groups, int count, ShadedQuantity quantity) {
    std::vector<int> quads;
    for (int q = 0; q < layer_.patches.patch_count(); ++q) {
      if (groups.group[q] >= 0 && groups.group[q] < count) quads.push_back(q);
    }
    CellTable table(layer_.patches.patch_count());
    const int total = static_cast<int>(quads.size());
    std::vector<PatchCells> chunk(kChunk);
    for (int begin = 0; begin < total; begin += kChunk) {
      const int end = std::min(begin + kChunk, total);
      arena_.execute([&] {
        tbb::parallel_for(begin, end, [&](int i) {
          chunk[i - begin] = fit_cells(layer_, quads[i], quantity, tolerance_);
        });
      });
      for (int i = begin; i < end; ++i) table.add(quads[i], chunk[i - begin]);
      report(0.5 * end / total);
    }
    agree_at_shared_sides(layer_.patches, groups, tolerance_, table);
    return table;
  }

  /// `part` of the work on one quantity is done.
  void report(double part) const { progress_((jobs_done_ + part) / jobs_); }

  /// Of the drawn patches.
  Eigen::AlignedBox2d bounds() const {
    Eigen::AlignedBox2d box;
    for (int q = 0; q < layer_.patches.patch_count(); ++q) {
      if (opacity_[q] == PatchOpacity::transparent) continue;
      for (const auto& row : to_bezier(placed_geometry(layer_, q)).control) {
        for (const Eigen::Vector2d& p : row) box.extend(p);
      }
    }
    return box;
  }

  /// With what patches reach beyond their edges.
  static Eigen::AlignedBox2d with_margin(const Eigen::AlignedBox2d& box) {
    constexpr double kMargin = 2;
    const Eigen::Vector2d margin(kMargin, kMargin);
    return box.isEmpty() ? box : Eigen::AlignedBox2d(box.min() - margin, box.max() + margin);
  }

  bool all(PatchOpacity opacity) const {
    return std::all_of(opacity_.begin(), opacity_.end(),
                       [&](PatchOpacity o) { return o == opacity; });
  }

  std::vector<char> where_not(PatchOpacity opacity) const {
    std::vector<char> where(opacity_.size());
    for (std::size_t q = 0; q < where.size(); ++q) where[q] = opacity_[q] != opacity;
    return where;
  }

  const Layer& layer_;
  double tolerance_;
  ScratchFile& scratch_;
  tbb::task_arena arena_;
  const std::function<void(double)>& progress_;
  std::vector<char> paintable_;
  std::vector<PatchOpacity> opacity_;
  CoordinateGrid grid_;
  int jobs_ = 1, jobs_done_ = 0;
};

}  // namespace

PaintedLayer paint_layer(const Layer& layer, bool fills_page, Transparency transparency,
                         double tolerance, ScratchFile& scratch, const RunContext& context,
                         const std::function<void(double)>& progress) {
  return LayerPainter(layer, tolerance, scratch, context, progress).run(fills_page, transparency);
}

}  // namespace quadrille
