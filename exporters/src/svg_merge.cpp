#include "svg_merge.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "svg_bleed.h"

namespace quadrille {
namespace {

double total_weight(const CellSamples& samples) {
  double sum = 0;
  for (int i = 0; i < samples.count; ++i) sum += samples.weight[i];
  return sum;
}

/// Samples of two sets together, from each about as many as its share of the weight but a quarter
/// at least: something small must not be lost within something large.
CellSamples joined(const CellSamples& a, const CellSamples& b) {
  const int n = std::min(CellSamples::kMost, a.count + b.count);
  const double wa = total_weight(a), wb = total_weight(b);
  const double share = wa + wb > 0 ? wa / (wa + wb) : 0.5;
  const int from_a = std::clamp(static_cast<int>(std::lround(n * share)), n / 4, n - n / 4);
  CellSamples both;
  both.count = n;
  int i = 0;
  const auto take = [&](const CellSamples& from, int count) {
    const int begin = i;
    double sum = 0;
    for (int k = 0; k < count; ++k, ++i) {
      const int source = static_cast<int>((k + 0.5) * from.count / count);
      both.position[i] = from.position[source];
      both.color[i] = from.color[source];
      sum += both.weight[i] = from.weight[source];
    }
    const double scale = sum > 0 ? total_weight(from) / sum : 0;
    for (int k = begin; k < i; ++k) both.weight[k] *= scale;
  };
  take(a, from_a);
  take(b, n - from_a);
  both.slopes = a.slopes + b.slopes;
  both.is_cut = a.is_cut || b.is_cut;
  return both;
}

class Merger {
 public:
  Merger(const CellMesh& mesh, std::vector<SvgCell> cells, double price, int units)
      : mesh_(mesh), price_(price), units_(units), groups_(cells.size()), group_of_(cells.size()) {
    for (int c = 0; c < static_cast<int>(cells.size()); ++c) {
      groups_[c] = {{{c}, cells[c].samples, cells[c].cost}, true};
      group_of_[c] = c;
    }
  }

  std::vector<MergedCells> run() {
    do {
      std::vector<Pair> fresh = changed_pairs();
      tbb::parallel_for(std::size_t{0}, fresh.size(),
                        [&](std::size_t i) { fresh[i].gain = gain(fresh[i].a, fresh[i].b); });
      pairs_.insert(pairs_.end(), fresh.begin(), fresh.end());
      for (Group& group : groups_) group.has_changed = false;
    } while (merge_best());
    std::vector<MergedCells> merged;
    for (Group& group : groups_) {
      if (!group.merged.cells.empty()) merged.push_back(std::move(group.merged));
    }
    return merged;
  }

 private:
  struct Group {
    MergedCells merged;  ///< without cells when it went into another
    bool has_changed = false;
  };
  struct Pair {
    int a, b;  ///< a < b
    double gain = 0;
  };

  /// Neighbours of which one has changed, and that no tear separates.
  std::vector<Pair> changed_pairs() const {
    std::vector<std::pair<int, int>> touching, torn;
    for (const CellMesh::Side& side : mesh_.sides()) {
      if (side.twin < 0) continue;
      const int a = group_of_[side.cell], b = group_of_[mesh_.side(side.twin).cell];
      if (a >= b || !(groups_[a].has_changed || groups_[b].has_changed)) continue;
      (side.is_torn ? torn : touching).emplace_back(a, b);
    }
    for (auto* list : {&touching, &torn}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    std::vector<Pair> pairs;
    for (const auto& pair : touching) {
      const bool is_torn = std::binary_search(torn.begin(), torn.end(), pair);
      if (!is_torn) pairs.push_back({pair.first, pair.second});
    }
    return pairs;
  }

  double gain(int a, int b) const {
    const MergedCells &first = groups_[a].merged, &second = groups_[b].merged;
    CellGroup both;
    both.cells = first.cells;
    both.cells.insert(both.cells.end(), second.cells.begin(), second.cells.end());
    both.is_later = [](int) { return false; };
    both.holds = [&](int cell) { return group_of_[cell] == a || group_of_[cell] == b; };
    const double apart = first.cost + second.cost;
    const PricedFill fill =
        priced_fill(group_outlines(mesh_, both, 0), joined(first.samples, second.samples), price_,
                    units_, apart);
    return apart - fill.cost;
  }

  /// Merges pairs, the best first, each group once at most. False when none is worth it.
  bool merge_best() {
    std::erase_if(pairs_, [](const Pair& pair) { return pair.gain <= 0; });
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair& x, const Pair& y) {
      return x.gain != y.gain ? x.gain > y.gain : std::pair(x.a, x.b) < std::pair(y.a, y.b);
    });
    for (const Pair& pair : pairs_) {
      if (!groups_[pair.a].has_changed && !groups_[pair.b].has_changed) merge(pair);
    }
    const bool any = !pairs_.empty();
    std::erase_if(pairs_, [&](const Pair& pair) {
      return groups_[pair.a].has_changed || groups_[pair.b].has_changed;
    });
    return any;
  }

  void merge(const Pair& pair) {
    MergedCells &into = groups_[pair.a].merged, &from = groups_[pair.b].merged;
    for (const int c : from.cells) group_of_[c] = pair.a;
    into.cells.insert(into.cells.end(), from.cells.begin(), from.cells.end());
    std::sort(into.cells.begin(), into.cells.end());
    into.samples = joined(into.samples, from.samples);
    into.cost += from.cost - pair.gain;
    from = {};
    groups_[pair.a].has_changed = groups_[pair.b].has_changed = true;
  }

  const CellMesh& mesh_;
  double price_;
  int units_;
  std::vector<Group> groups_;
  std::vector<int> group_of_;  ///< per cell
  std::vector<Pair> pairs_;
};

}  // namespace

std::vector<MergedCells> merge_cells(const CellMesh& mesh, std::vector<SvgCell> cells, double price,
                                     int units_per_pixel) {
  return Merger(mesh, std::move(cells), price, units_per_pixel).run();
}

}  // namespace quadrille
