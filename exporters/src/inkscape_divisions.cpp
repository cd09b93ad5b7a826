#include "inkscape_divisions.h"

#include <algorithm>
#include <cmath>

#include "inkscape_slopes.h"
#include "subdivision.h"

namespace quadrille {
namespace {

constexpr int kMostBilinear = 8, kMostBicubic = 2;

GridDivisions bilinear(const PlacedGrid& grid, double tolerance) {
  GridDivisions result{std::vector<int>(grid.columns(), 1), std::vector<int>(grid.rows(), 1)};
  for (int j = 0; j < grid.rows(); ++j) {
    for (int i = 0; i < grid.columns(); ++i) {
      const Divisions wished =
          bilinear_divisions(grid.color(i, j), tolerance / 255, {kMostBilinear, kMostBilinear});
      result.columns[i] = std::max(result.columns[i], wished.u);
      result.rows[j] = std::max(result.rows[j], wished.v);
    }
  }
  return result;
}

/// A grid as seen along its rows (or columns), with the lines that cross these.
struct View {
  const PlacedGrid& grid;
  bool along_rows;

  Color color(const GridLine& along, const GridLine& across) const {
    return along_rows ? grid.color(along.quad, across.quad).at(along.at, across.at)
                      : grid.color(across.quad, along.quad).at(across.at, along.at);
  }
  Eigen::Vector2d position(const GridLine& along, const GridLine& across) const {
    return along_rows ? grid.position(along.quad, across.quad).at(along.at, across.at)
                      : grid.position(across.quad, along.quad).at(across.at, along.at);
  }
};

/// Mean squared errors per column (row) of quads of interpolating smoothly along a line of the
/// grid.
class LineErrors {
 public:
  explicit LineErrors(std::size_t quads) : sums_(quads, 0), counts_(quads, 0) {}

  void add(const View& view, const std::vector<GridLine>& nodes, const GridLine& line) {
    NodeLine values;
    for (const GridLine& node : nodes)
      values.add(view.position(node, line), view.color(node, line));
    const std::vector<Color> slopes = values.slopes();
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      const double end = nodes[i + 1].quad > nodes[i].quad ? 1 : nodes[i + 1].at;
      for (const double t : {0.25, 0.5, 0.75}) {
        const GridLine between{nodes[i].quad, nodes[i].at + t * (end - nodes[i].at)};
        const Color truth = view.color(between, line).cwiseMax(0.0f).cwiseMin(1.0f);
        const Color error = truth - values.between(i, t, slopes);
        sums_[between.quad] += error.head<3>().square().mean();
        ++counts_[between.quad];
      }
    }
  }

  double mean_squared(int quad) const { return sums_[quad] / counts_[quad]; }

 private:
  std::vector<double> sums_;
  std::vector<int> counts_;
};

/// Doubles the parts of the columns (rows) along which the error is too large; true when any was.
bool refine(const View& view, std::vector<int>& divisions, const std::vector<GridLine>& across,
            double tolerance) {
  LineErrors errors(divisions.size());
  const std::vector<GridLine> nodes = lines_of(divisions);
  for (const GridLine& line : across) errors.add(view, nodes, line);
  bool refined = false;
  for (std::size_t q = 0; q < divisions.size(); ++q) {
    const double error = 255 * std::sqrt(errors.mean_squared(static_cast<int>(q)));
    if (error <= 0.5 * tolerance || divisions[q] == kMostBicubic) continue;
    divisions[q] *= 2;
    refined = true;
  }
  return refined;
}

GridDivisions smooth(const PlacedGrid& grid, double tolerance) {
  GridDivisions result{std::vector<int>(grid.columns(), 1), std::vector<int>(grid.rows(), 1)};
  for (bool again = true; again;) {
    const std::vector<GridLine> columns = lines_of(result.columns), rows = lines_of(result.rows);
    const bool more_columns = refine({grid, true}, result.columns, rows, tolerance);
    const bool more_rows = refine({grid, false}, result.rows, columns, tolerance);
    again = more_columns || more_rows;
  }
  return result;
}

}  // namespace

std::vector<GridLine> lines_of(const std::vector<int>& divisions) {
  std::vector<GridLine> lines;
  for (int q = 0; q < static_cast<int>(divisions.size()); ++q) {
    for (int k = 0; k < divisions[q]; ++k) lines.push_back({q, double(k) / divisions[q]});
  }
  lines.push_back({static_cast<int>(divisions.size()) - 1, 1});
  return lines;
}

GridDivisions divisions_of(const PlacedGrid& grid, bool bicubic, double tolerance) {
  return bicubic ? smooth(grid, tolerance) : bilinear(grid, tolerance);
}

}  // namespace quadrille
