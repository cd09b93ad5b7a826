#include "svg_paint.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "svg_bleed.h"
#include "svg_merge.h"
#include "svg_path.h"

namespace quadrille {
namespace {

/// How far paint goes on under what is painted later, in pixels of the picture. Of a pixel on a
/// seam along rows or columns at scale 1, at most a 64th is then left to what lies below the two:
/// the later one covers a share f, the other what lies within the bleed of the seam, min(1, 7/4 -
/// f), and (1 - f) (f - 3/4) is largest in the middle. More bleed would show where cells are thin.
constexpr double kBleed = 0.75;

std::vector<SvgCell> divided(const SvgLayer& layer, const std::vector<int>& quads, CellPaint paint,
                             const SvgDetail& detail) {
  std::vector<std::vector<SvgCell>> of_patch(quads.size());
  tbb::parallel_for(std::size_t{0}, quads.size(), [&](std::size_t i) {
    of_patch[i] = divide_into_cells(layer, quads[i], paint, detail);
  });
  std::vector<SvgCell> cells;
  for (auto& some : of_patch) {
    cells.insert(cells.end(), std::make_move_iterator(some.begin()),
                 std::make_move_iterator(some.end()));
  }
  return cells;
}

double area_of(const CellMesh& mesh, const MergedCells& group) {
  double area = 0;
  for (const int c : group.cells) {
    for (int s = mesh.side_begin(c); s < mesh.side_begin(c + 1); ++s) {
      const Eigen::Vector2d a = mesh.points(s).front(), b = mesh.points(mesh.side(s).next).front();
      area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
  }
  return area;
}

/// Groups of several cells by falling area, so that small ones lie above large ones, then the other
/// cells as they come.
std::vector<MergedCells> in_order(const CellMesh& mesh, std::vector<MergedCells> groups) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const bool is_single = groups[i].cells.size() == 1;
    order.emplace_back(is_single ? 0 : std::min(0.0, -area_of(mesh, groups[i])), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<MergedCells> sorted;
  for (const auto& [area, i] : order) sorted.push_back(std::move(groups[i]));
  return sorted;
}

}  // namespace

std::vector<SvgPaint> paint_patches(const SvgLayer& layer, const std::vector<int>& quads,
                                    CellPaint paint, const SvgDetail& detail) {
  std::vector<SvgCell> cells = divided(layer, quads, paint, detail);
  std::vector<PatchCell> parts;
  for (const SvgCell& cell : cells) parts.push_back(cell.part);
  const CellMesh mesh(layer, parts, paint);
  const double price = price_of(detail, paint);
  const std::vector<MergedCells> groups =
      in_order(mesh, merge_cells(mesh, std::move(cells), price, detail.units_per_pixel));

  std::vector<std::size_t> place(parts.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const int c : groups[i].cells) place[c] = i;
  }
  std::vector<SvgPaint> painted(groups.size());
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t i) {
    const CellGroup group{groups[i].cells, [&, i](int c) { return place[c] == i; },
                          [&, i](int c) { return place[c] > i; }};
    painted[i].outlines = group_outlines(mesh, group, kBleed);
    painted[i].fill =
        priced_fill(painted[i].outlines, groups[i].samples, price, detail.units_per_pixel).fill;
  });
  return painted;
}

}  // namespace quadrille
