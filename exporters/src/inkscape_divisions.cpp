#include "inkscape_divisions.h"

#include <algorithm>
#include <cmath>

#include "inkscape_slopes.h"
#include "subdivision.h"

namespace quadrille {
namespace {

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

/// Mean squared error, over red, green and blue, of interpolating smoothly along the lines.
double mean_squared_error(const View& view, const std::vector<GridLine>& nodes,
                          const std::vector<GridLine>& lines) {
  double sum = 0;
  int count = 0;
  for (const GridLine& line : lines) {
    NodeLine values;
    for (const GridLine& node : nodes) {
      values.add(view.position(node, line), view.color(node, line));
    }
    const std::vector<Color> slopes = values.slopes();
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      for (const double t : {0.25, 0.5, 0.75}) {
        const Color truth = view.color({nodes[i].quad, t}, line);
        const Color error = truth.cwiseMax(0.0f).cwiseMin(1.0f) - values.between(i, t, slopes);
        sum += error.head<3>().square().mean();
        ++count;
      }
    }
  }
  return sum / count;
}

GridDivisions undivided(const PlacedGrid& grid) {
  return {std::vector<int>(grid.columns(), 1), std::vector<int>(grid.rows(), 1)};
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

bool is_faithful_bicubic(const PlacedGrid& grid, double tolerance) {
  if (grid.columns() < 2 || grid.rows() < 2) return false;
  const std::vector<GridLine> columns = lines_of(undivided(grid).columns);
  const std::vector<GridLine> rows = lines_of(undivided(grid).rows);
  // The errors of the two directions are about independent.
  const double squared = mean_squared_error({grid, true}, columns, rows) +
                         mean_squared_error({grid, false}, rows, columns);
  return 255 * std::sqrt(squared) <= 0.5 * tolerance;
}

GridDivisions divisions_of(const PlacedGrid& grid, bool bicubic, double tolerance) {
  GridDivisions result = undivided(grid);
  if (bicubic) return result;
  for (int j = 0; j < grid.rows(); ++j) {
    for (int i = 0; i < grid.columns(); ++i) {
      const Divisions wished = bilinear_divisions(grid.color(i, j), tolerance / 255);
      result.columns[i] = std::max(result.columns[i], wished.u);
      result.rows[j] = std::max(result.rows[j], wished.v);
    }
  }
  return result;
}

}  // namespace quadrille
