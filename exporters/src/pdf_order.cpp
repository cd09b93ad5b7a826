#include "pdf_order.h"

#include <algorithm>
#include <optional>

namespace quadrille {
namespace {

constexpr int opposite(int side) { return (side + 2) & 3; }

bool is_right(int corner) { return corner == 1 || corner == 2; }
bool is_low(int corner) { return corner >= 2; }  // y down: at high v

/// Cells beside each other along this side of a patch.
int count_along(const Divisions& count, int side) { return side & 1 ? count.v : count.u; }

class Visitor {
 public:
  Visitor(const QuadMesh& mesh, const PaintGroups& groups, const CellTable& cells)
      : mesh_(mesh), groups_(groups), cells_(cells), visited_(mesh.quad_count(), 0) {}

  std::vector<PatchVisit> run(int group) {
    std::vector<PatchVisit> visits;
    for (int start = 0; start < mesh_.quad_count(); ++start) {
      if (groups_.group[start] != group || !reaches(start)) visited_[start] = 1;
    }
    visit_all(visits);
    for (int start = 0; start < mesh_.quad_count(); ++start) {
      visited_[start] = groups_.group[start] != group || reaches(start);
    }
    visit_all(visits);
    return visits;
  }

 private:
  void visit_all(std::vector<PatchVisit>& visits) {
    for (int start = 0; start < mesh_.quad_count(); ++start) {
      std::optional<Arrival> arrival;
      if (!visited_[start]) arrival = Arrival{start, -1};
      while (arrival) arrival = visit(*arrival, visits);
    }
  }

  /// True when the patch goes on beyond a side, where it may lie over others.
  bool reaches(int quad) const {
    for (int h = 4 * quad; h < 4 * quad + 4; ++h) {
      const Across beyond = across(mesh_, groups_, h);
      if (beyond == Across::open || beyond == Across::outside) return true;
    }
    return false;
  }

  struct Arrival {
    int quad;
    int entry;  ///< side on which the patch is entered, or -1
  };

  /// The start corners that an arrival allows: the ends of the side on which it comes.
  static bool allows(const Arrival& a, int corner) {
    return a.entry < 0 || corner == a.entry || corner == ((a.entry + 1) & 3);
  }

  std::optional<Arrival> visit(const Arrival& a, std::vector<PatchVisit>& visits) {
    visited_[a.quad] = 1;
    const Divisions count = cells_.count(a.quad);
    PatchVisit best{a.quad, a.entry, -1, std::max(a.entry, 0), count.u >= count.v};
    std::optional<Arrival> next;
    int fewest = 5;
    for (int corner = 0; corner < 4; ++corner) {
      if (!allows(a, corner)) continue;
      for (const bool rows_first : {true, false}) {
        PatchVisit way{a.quad, a.entry, -1, corner, rows_first};
        const CellStep last = way.cells(count).back();
        for (int side = 0; side < 4; ++side) {
          const std::optional<Arrival> there = across_side(a.quad, last, side);
          if (!there) continue;
          const int ways = ways_on(there->quad);
          if (ways >= fewest) continue;
          fewest = ways, next = there, best = way, best.exit = side;
        }
      }
    }
    visits.push_back(best);
    return next;
  }

  /// Where the way goes on when it leaves the patch from its last cell across that side: only where
  /// both patches have a single cell along it. Of several, one would share its side and the others
  /// would not, and viewers could leave a gap between these.
  std::optional<Arrival> across_side(int quad, const CellStep& last, int side) const {
    const Divisions count = cells_.count(quad);
    const int depth = side & 1 ? last.i : last.j;
    const int border = side == 1 ? count.u - 1 : side == 2 ? count.v - 1 : 0;
    if (depth != border || (last.shares_entry && last.entry == side)) return {};
    const int h = 4 * quad + side;
    if (across(mesh_, groups_, h) != Across::same || count_along(count, side) != 1) return {};
    const int twin = mesh_.twin(h), other = QuadMesh::quad_of(twin);
    const int its_side = QuadMesh::corner_of(twin);
    if (visited_[other] || count_along(cells_.count(other), its_side) != 1) return {};
    const int far = (side + 1) & 3, its_far = (its_side + 1) & 3;
    if (!look_alike(corner_color(quad, side), corner_color(other, its_far)) ||
        !look_alike(corner_color(quad, far), corner_color(other, its_side))) {
      return {};
    }
    return Arrival{other, its_side};
  }

  const CellTable::Node& corner_color(int quad, int corner) const {
    const Divisions count = cells_.count(quad);
    return cells_.node(quad, is_right(corner) ? count.u : 0, is_low(corner) ? count.v : 0);
  }

  /// The colours are fitted patch by patch, so that neighbours' differ at a corner that they share.
  static bool look_alike(const CellTable::Node& a, const CellTable::Node& b) {
    constexpr int kMost = 2;  // 8-bit steps
    for (int c = 0; c < 3; ++c) {
      if (std::abs(a[c] - b[c]) > kMost) return false;
    }
    return true;
  }

  /// Patches that could come after this one.
  int ways_on(int quad) const {
    int ways = 0;
    for (int h = 4 * quad; h < 4 * quad + 4; ++h) {
      if (across(mesh_, groups_, h) == Across::same) {
        ways += !visited_[QuadMesh::quad_of(mesh_.twin(h))];
      }
    }
    return ways;
  }

  const QuadMesh& mesh_;
  const PaintGroups& groups_;
  const CellTable& cells_;
  std::vector<char> visited_;
};

}  // namespace

std::vector<CellStep> PatchVisit::cells(const Divisions& count) const {
  const int length = rows_first ? count.u : count.v, lines = rows_first ? count.v : count.u;
  bool forward = rows_first ? !is_right(start_corner) : !is_low(start_corner);
  const bool lines_forward = rows_first ? !is_low(start_corner) : !is_right(start_corner);
  const int high = rows_first ? 1 : 2, next_line = rows_first ? 2 : 1;  // sides toward more
  std::vector<CellStep> steps;
  for (int l = 0; l < lines; ++l, forward = !forward) {
    for (int k = 0; k < length; ++k) {
      const int along = forward ? k : length - 1 - k, line = lines_forward ? l : lines - 1 - l;
      CellStep step{rows_first ? along : line, rows_first ? line : along, 0, true};
      if (k > 0) {
        step.entry = forward ? opposite(high) : high;
      } else if (l > 0) {
        step.entry = lines_forward ? opposite(next_line) : next_line;
      } else if (entry >= 0) {
        step.entry = entry;
      } else {
        step.shares_entry = false;
      }
      steps.push_back(step);
    }
  }
  return steps;
}

std::vector<PatchVisit> visit_patches(const QuadMesh& mesh, const PaintGroups& groups, int group,
                                      const CellTable& cells) {
  return Visitor(mesh, groups, cells).run(group);
}

}  // namespace quadrille
