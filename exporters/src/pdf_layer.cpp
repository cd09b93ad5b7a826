#include "pdf_layer.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "arena_size.h"
#include "paintable_patch.h"
#include "patch_opacity.h"
#include "pdf_agree.h"
#include "pdf_region_path.h"
#include "pdf_tear_lines.h"

namespace quadrille {
namespace {

/// Patches that are fitted together; bounds the memory.
constexpr int kChunk = 512;

/// Patches whose alpha is nearer than this to 0 or 1 need no mask, which viewers draw with gaps
/// between cells. The quantised document stores 1 as less now and then, by a step of 8 bits.
double opacity_tolerance(double tolerance) { return std::max(1.0, 0.5 * tolerance) / 255; }

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
        opacity_(paint_opacities(layer.patches, opacity_tolerance(tolerance), paintable_)) {}

  PaintedLayer run(bool fills_page, Transparency transparency) {
    PaintedLayer painted;
    const Eigen::AlignedBox2d box = bounds();
    painted.grid = grid_ = CoordinateGrid::covering(with_margin(box));

    const std::vector<char> drawn = where_not(PatchOpacity::transparent);
    PaintGroups groups = paint_groups(layer_.patches.mesh, drawn, paintable_);
    groups.open_border = groups.open_unpainted = true;  // the page or the part cuts them off
    const bool flatten = transparency == Transparency::over_white;
    const auto quantity = flatten ? ShadedQuantity::over_white : ShadedQuantity::color;
    const bool masked = !flatten && any(PatchOpacity::translucent);
    jobs_ = masked ? 5 : 2;
    const CellTable cells = fitted(groups, quantity);
    const auto add_part = [&](const PaintGroups& own) -> PaintedPart& {
      return painted.parts.emplace_back(
          PaintedPart{underlay(layer_, own, cells, box), steps(own, quantity, cells), {}, {}});
    };
    if (masked) {
      PaintGroups translucent = among(where(PatchOpacity::translucent), groups);
      PaintedPart& part = add_part(translucent);
      translucent.open_border = fills_page;
      translucent.open_unpainted = false;
      const CellTable alphas = fitted(translucent, ShadedQuantity::alpha);
      part.alpha = steps(translucent, ShadedQuantity::alpha, alphas);
    }
    const std::vector<char> rest = masked ? where(PatchOpacity::opaque) : drawn;
    PaintedPart& part = add_part(among(rest, groups));
    const bool all = std::ranges::all_of(rest, [](char is) { return is != 0; });
    if (!fills_page || !all) part.region = region(border_of(layer_.patches.mesh, rest));
    return painted;
  }

 private:
  /// The groups of these patches alone; the others hide or cut off whatever reaches there.
  static PaintGroups among(const std::vector<char>& patches, PaintGroups groups) {
    for (std::size_t q = 0; q < patches.size(); ++q) {
      if (groups.group[q] >= 0 && !patches[q]) groups.group[q] = groups.count;
    }
    return groups;
  }

  std::vector<PaintStep> steps(const PaintGroups& groups, ShadedQuantity quantity,
                               const CellTable& cells) {
    const QuadMesh& mesh = layer_.patches.mesh;
    std::vector<PaintStep> all;
    for (int g = 0; g < groups.count; ++g) {
      const auto visits = visit_patches(mesh, groups, g, cells);
      if (visits.empty()) continue;
      const auto share = [&](double part) { report((g + part) / groups.count); };
      PaintStep& step = all.emplace_back();
      step.shading = coons_shading(layer_, groups, visits, cells, grid_, quantity, scratch_, share);
      step.region = region(group_region(mesh, groups, g));
      if (quantity != ShadedQuantity::color) continue;
      const TearLines lines = tear_lines(layer_.patches, groups, g);
      step.growing = edges_path(layer_, lines.growing, PaintedLayer::kPathUnits);
      step.shrinking = edges_path(layer_, lines.shrinking, PaintedLayer::kPathUnits);
    }
    ++jobs_done_;
    return all;
  }

  std::string region(const std::vector<EdgeLoop>& loops) const {
    return region_path(layer_, loops, PaintedLayer::kPathUnits);
  }

  CellTable fitted(const PaintGroups& groups, ShadedQuantity quantity) {
    std::vector<int> quads;
    for (int q = 0; q < layer_.patches.patch_count(); ++q) {
      if (groups.paints(q)) quads.push_back(q);
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
      report(double(end) / total);
    }
    agree_at_shared_sides(layer_.patches, groups, tolerance_, table);
    ++jobs_done_;
    return table;
  }

  /// `part` of the job under way is done.
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

  bool any(PatchOpacity opacity) const {
    return std::ranges::find(opacity_, opacity) != opacity_.end();
  }

  std::vector<char> where(PatchOpacity opacity) const {
    std::vector<char> where(opacity_.size());
    std::ranges::transform(opacity_, where.begin(), [&](PatchOpacity o) { return o == opacity; });
    return where;
  }

  std::vector<char> where_not(PatchOpacity opacity) const {
    std::vector<char> where = this->where(opacity);
    for (char& is : where) is = !is;
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
