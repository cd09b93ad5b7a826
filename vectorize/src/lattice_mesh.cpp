#include <algorithm>
#include <cmath>
#include <string>

#include "quadrille/error.h"
#include "quadrille/quad_extraction.h"

namespace quadrille {

QuadMesh lattice_mesh(double width, double height, int columns, int rows) {
  if (!(width > 0) || !(height > 0) || columns < 1 || rows < 1) {
    throw Error(ErrorCode::invalid_argument,
                "a lattice of " + std::to_string(columns) + " x " + std::to_string(rows) +
                    " cells cannot be made; use positive sides and counts");
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
  const double edge = std::sqrt(width * height / std::max(1, quads));
  const auto side = [&](double length) {
    return std::clamp(static_cast<int>(std::lround(length / edge)), 1, std::max(1, quads));
  };
  return lattice_mesh(width, height, side(width), side(height));
}

}  // namespace quadrille
