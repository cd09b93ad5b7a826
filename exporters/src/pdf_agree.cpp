#include "pdf_agree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quadrille {
namespace {

using Node = CellTable::Node;

/// The colours along a side of a patch, from corner to corner around it.
class SideNodes {
 public:
  SideNodes(const CellTable& cells, int h)
      : quad_(QuadMesh::quad_of(h)), side_(QuadMesh::corner_of(h)), count_(cells.count(quad_)) {}

  int cells() const { return side_ & 1 ? count_.v : count_.u; }
  int quad() const { return quad_; }
  /// Column and row of node k.
  std::pair<int, int> at(int k) const {
    switch (side_) {
      case 0:
        return {k, 0};
      case 1:
        return {count_.u, k};
      case 2:
        return {count_.u - k, count_.v};
      default:
        return {0, count_.v - k};
    }
  }
  const Node& node(const CellTable& cells, int k) const {
    const auto [i, j] = at(k);
    return cells.node(quad_, i, j);
  }
  /// Between the nodes at t = 0 ... 1.
  std::array<double, 3> color(const CellTable& cells, double t) const {
    const int cell = std::min(static_cast<int>(t * this->cells()), this->cells() - 1);
    const double part = t * this->cells() - cell;
    const Node &a = node(cells, cell), &b = node(cells, cell + 1);
    std::array<double, 3> color;
    for (int c = 0; c < 3; ++c) color[c] = (1 - part) * a[c] + part * b[c];
    return color;
  }

 private:
  int quad_, side_;
  Divisions count_;
};

/// Nodes between the corners of half-edge h, halfway to the colours on the other side.
void meet_along(const CellTable& fitted, int h, int twin, double limit, CellTable& cells) {
  const SideNodes mine(fitted, h), its(fitted, twin);
  for (int k = 1; k < mine.cells(); ++k) {
    const Node& here = mine.node(fitted, k);
    const auto there = its.color(fitted, 1 - double(k) / mine.cells());
    Node met{};
    bool near = true;
    for (int c = 0; c < 3; ++c) {
      near = near && std::abs(here[c] - there[c]) <= limit;
      // Halves go to even numbers: on both sides the same, and on the whole neither up nor down.
      met[c] = static_cast<std::uint8_t>(std::nearbyint(0.5 * (here[c] + there[c])));
    }
    const auto [i, j] = mine.at(k);
    if (near) cells.node(mine.quad(), i, j) = met;
  }
}

/// The corners around a vertex, of the patches that go over into each other there.
void meet_at(const std::vector<int>& corners, const CellTable& fitted, double limit,
             CellTable& cells) {
  std::array<int, 3> sum{}, least{255, 255, 255}, most{};
  for (const int h : corners) {
    const Node& node = SideNodes(fitted, h).node(fitted, 0);
    for (int c = 0; c < 3; ++c) {
      sum[c] += node[c];
      least[c] = std::min<int>(least[c], node[c]), most[c] = std::max<int>(most[c], node[c]);
    }
  }
  Node mean{};
  const int count = static_cast<int>(corners.size());
  for (int c = 0; c < 3; ++c) {
    if (most[c] - least[c] > limit) return;
    mean[c] = static_cast<std::uint8_t>(std::nearbyint(double(sum[c]) / count));
  }
  for (const int h : corners) {
    const SideNodes side(fitted, h);
    const auto [i, j] = side.at(0);
    cells.node(side.quad(), i, j) = mean;
  }
}

}  // namespace

void agree_at_shared_sides(const PatchMesh& patches, const PaintGroups& groups, double limit,
                           CellTable& cells) {
  const QuadMesh& mesh = patches.mesh;
  const CellTable fitted = cells;
  const auto painted = [&](int h) { return cells.count(QuadMesh::quad_of(h)).u > 0; };
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    const int twin = mesh.twin(h);
    if (twin < 0 || !painted(h) || !painted(twin)) continue;
    const Across other = across(mesh, groups, h), back = across(mesh, groups, twin);
    if (other == Across::same || other == Across::smooth || back == Across::smooth) {
      meet_along(fitted, h, twin, limit, cells);
    }
  }
  std::vector<std::vector<int>> corners(patches.wedges.size());
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (painted(h)) corners[patches.wedge_of_corner[h]].push_back(h);
  }
  for (const auto& around : corners) {
    if (!around.empty()) meet_at(around, fitted, limit, cells);
  }
}

}  // namespace quadrille
