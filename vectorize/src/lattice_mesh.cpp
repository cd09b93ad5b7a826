#include <algorithm>
#include <cmath>
#include <string>

#include "quadrille/error.h"
#include "quadrille/quad_extraction.h"

namespace quadrille {
namespace {

constexpr double kMaxCells = 1e8;  // half-edges are numbered by int

}  // namespace

QuadMesh lattice_mesh(double width, double height, int columns, int rows) {
  if (!(width > 0) || !(height > 0) || columns < 1 || rows < 1) {
    throw Error(ErrorCode::invalid_argument,
                "a lattice of " + std::to_string(columns) + " x " + std::to_string(rows) +
                    " cells cannot be made; use positive sides and counts");
  }
  if (static_cast<double>(columns) * rows > kMaxCells) {
    throw Error(ErrorCode::limit_exceeded, "a lattice of " + std::to_string(columns) + " x " +
                                               std::to_string(rows) +
                                               " cells is too large; ask for fewer");
  }
  std::vector<Eigen::Vector2d> vertices;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      vertices.emplace_back(i == columns ? width : width * i / columns,
                            j == rows ? height : height * j / rows);
    }
  }
  std::vector<QuadMesh::Quad> quads;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int v = j * (columns + 1) + i;
      quads.push_back({v, v + 1, v + columns + 2, v + columns + 1});
    }
  }
  return QuadMesh(std::move(vertices), std::move(quads));
}

QuadMesh lattice_mesh(double width, double height, int quads) {
  const int wished = std::max(1, quads);
  const double edge = std::sqrt(width * height / wished);
  // The shorter side is rounded to squares, the longer one to the count.
  const int across_short =
      std::clamp(static_cast<int>(std::lround(std::min(width, height) / edge)), 1, wished);
  const int along_long =
      std::max(1, static_cast<int>(std::lround(static_cast<double>(wished) / across_short)));
  return width < height ? lattice_mesh(width, height, across_short, along_long)
                        : lattice_mesh(width, height, along_long, across_short);
}

}  // namespace quadrille
