#include "grid_decomposition.h"

#include <algorithm>
#include <queue>
#include <tuple>

namespace quadrille {
namespace {

/// A grid that could be cut out: its size and the top of its quad in the upper left.
struct Candidate {
  int columns = 0, rows = 0;
  int corner = -1;

  int area() const { return columns * rows; }
  bool operator<(const Candidate& other) const {
    const auto rank = [](const Candidate& c) {
      return std::tuple(c.area(), std::min(c.columns, c.rows), -c.corner);
    };
    return rank(*this) < rank(other);
  }
};

class GridCutter {
 public:
  GridCutter(const QuadMesh& mesh, std::span<const unsigned char> kinds,
             const std::function<void(double)>& progress)
      : mesh_(mesh),
        kinds_(kinds.begin(), kinds.end()),
        progress_(progress),
        visited_(mesh.quad_count(), 0) {}

  /// Sizes only shrink as quads are cut out. So each candidate starts with the most there may be,
  /// and one that turns out to be as large as was thought when it is the first of all is the
  /// largest now.
  std::vector<QuadGrid> cut() {
    std::priority_queue<Candidate> candidates;
    for (int h = 0; h < mesh_.halfedge_count(); ++h) {
      if (!kinds_[QuadMesh::quad_of(h)]) continue;
      candidates.push({QuadGrid::kMostPerSide, QuadGrid::kMostPerSide, h});
    }
    std::vector<QuadGrid> grids;
    while (!candidates.empty()) {
      const Candidate best = candidates.top();
      candidates.pop();
      if (!kinds_[QuadMesh::quad_of(best.corner)]) continue;
      report();
      const Candidate now = largest_from(best.corner);
      if (now < best) {
        candidates.push(now);
      } else {
        grids.push_back(taken(now));
      }
    }
    return grids;
  }

 private:
  /// `neighbour`, a result of right_of() or below() of h across `edge`, or -1 where a grid ends.
  int within_grid(int h, int neighbour, int edge) const {
    if (neighbour < 0 || mesh_.is_tear(edge)) return -1;
    const int from = QuadMesh::quad_of(h), to = QuadMesh::quad_of(neighbour);
    return kinds_[from] == kinds_[to] ? neighbour : -1;
  }
  int right(int h) const {
    return within_grid(h, right_of(mesh_, h), mesh_.edge(QuadMesh::next(h)));
  }
  int down(int h) const {
    return within_grid(h, below(mesh_, h), mesh_.edge(QuadMesh::next(QuadMesh::next(h))));
  }

  /// The fraction is of quads that are taken, which only grows.
  void report() {
    constexpr long long kPerReport = 4096;
    if (evaluation_ % kPerReport != 0) return;
    progress_(double(taken_) / mesh_.quad_count());
  }

  /// Marks the quad as visited in this evaluation; false when it has been already, as where a mesh
  /// runs in a ring.
  bool visit(int h) {
    long long& visited = visited_[QuadMesh::quad_of(h)];
    if (visited == evaluation_) return false;
    visited = evaluation_;
    return true;
  }

  /// The largest grid to the right of and below the corner.
  Candidate largest_from(int corner) {
    ++evaluation_;
    std::vector<int> row;
    for (int h = corner; h >= 0 && row.size() < QuadGrid::kMostPerSide && visit(h); h = right(h)) {
      row.push_back(h);
    }
    Candidate best{static_cast<int>(row.size()), 1, corner};
    for (int rows = 2; rows <= QuadGrid::kMostPerSide; ++rows) {
      row = row_below(row);
      if (row.empty()) break;
      best = std::max(best, Candidate{static_cast<int>(row.size()), rows, corner});
    }
    return best;
  }

  /// The quads below those of the row that are beside each other as those are: around the vertices
  /// between them there are four quads each.
  std::vector<int> row_below(const std::vector<int>& row) {
    std::vector<int> result;
    for (const int h : row) {
      const int next = down(h);
      const bool fits = next >= 0 && (result.empty() || right(result.back()) == next);
      if (!fits || !visit(next)) break;
      result.push_back(next);
    }
    return result;
  }

  /// Takes the candidate's quads out of the mesh.
  QuadGrid taken(const Candidate& candidate) {
    QuadGrid grid{candidate.columns, candidate.rows, {}};
    for (int first = candidate.corner, j = 0; j < grid.rows; first = down(first), ++j) {
      for (int h = first, i = 0; i < grid.columns; h = right(h), ++i) grid.tops.push_back(h);
      if (j + 1 == grid.rows) break;
    }
    for (const int h : grid.tops) kinds_[QuadMesh::quad_of(h)] = 0;
    taken_ += static_cast<int>(grid.tops.size());
    return grid;
  }

  const QuadMesh& mesh_;
  std::vector<unsigned char> kinds_;  ///< 0 for quads that are taken
  const std::function<void(double)>& progress_;
  int taken_ = 0;
  std::vector<long long> visited_;  ///< per quad the last evaluation that reached it
  long long evaluation_ = 0;
};

}  // namespace

int right_of(const QuadMesh& mesh, int h) {
  const int across = mesh.twin(QuadMesh::next(h));
  return across < 0 ? -1 : QuadMesh::next(across);
}

int below(const QuadMesh& mesh, int h) { return mesh.twin(QuadMesh::next(QuadMesh::next(h))); }

std::vector<QuadGrid> regular_grids(const QuadMesh& mesh, std::span<const unsigned char> kinds,
                                    const std::function<void(double)>& progress) {
  return GridCutter(mesh, kinds, progress).cut();
}

}  // namespace quadrille
