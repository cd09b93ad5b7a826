#include "outline_sampling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "arc_division.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kReach = 0.35;     // of lattice points to the outline, in spacings
constexpr double kClosest = 0.5;    // least distance between samples along the outline, in spacings
constexpr double kLeastArc = 0.25;  // pixels
constexpr ArcTolerance kTolerance = {.most_bulge = 0.2,
                                     .distance = 0.4,
                                     .coarse_distance = 0.03,
                                     .shortest = 2,
                                     .coarse_shortest = 0.2};
constexpr int kLeastSamples = 4;  // per loop
constexpr int kRepairRounds = 12;

Vector2d on_grid(const Vector2d& p) {
  return {std::round(p.x() * 64) / 64, std::round(p.y() * 64) / 64};
}

/// The samples of one loop, by arc length.
class LoopSampler {
 public:
  LoopSampler(const Contour& contour, const Spacing& spacing)
      : contour_(contour), spacing_(spacing) {
    for (const double s : contour.marks()) samples_[s] = {};
  }

  /// A sample for a lattice point at s, or the one nearby: the key of either.
  double take(double s, double spacing) {
    if (s >= contour_.length()) s -= contour_.length();
    const double closest = std::max(kClosest * spacing, kLeastArc);
    double best = s, best_distance = closest;
    if (!samples_.empty()) {
      const auto after = samples_.lower_bound(s);
      const double next = after == samples_.end() ? samples_.begin()->first : after->first;
      const double before =
          after == samples_.begin() ? samples_.rbegin()->first : std::prev(after)->first;
      for (const double candidate : {before, next}) {
        const double distance = contour_.distance_along(candidate, s);
        if (distance < best_distance) best = candidate, best_distance = distance;
      }
    }
    samples_.try_emplace(best);
    return best;
  }

  void fill_gaps() {
    if (samples_.empty()) samples_[0] = {};
    for (const auto& [from, to] : arcs()) {
      const double whole = to - from;
      const int parts = edge_count(whole, [&, start = from](double t0, double t1) {
        return spacing_(contour_.at(start + whole * (0.5 * (t0 + t1))));
      });
      for (int k = 1; k < parts; ++k) add(from + whole * k / parts);
      for (int k = 0; k < parts; ++k) {
        refine(from + whole * k / parts, from + whole * (k + 1) / parts);
      }
    }
    while (samples_.size() < kLeastSamples) {
      const auto all = arcs();
      const auto longest = std::max_element(
          all.begin(), all.end(), [](auto& a, auto& b) { return a[1] - a[0] < b[1] - b[0]; });
      add(0.5 * ((*longest)[0] + (*longest)[1]));
    }
  }

  /// Divides an arc at the outline's own point nearest to its middle, and puts its ends exactly on
  /// the outline. False when there is no such point.
  bool divide(const std::array<double, 2>& arc) {
    const auto [from, to] = arc;
    samples_.at(key(from)).exact = samples_.at(key(to)).exact = true;
    const double middle = contour_.arc_of(contour_.nearest_point(0.5 * (from + to)));
    const bool is_between =
        !samples_.contains(middle) &&
        contour_.distance_along(middle, 0.5 * (from + to)) < 0.5 * (to - from) * (1 - 1e-9);
    if (is_between) samples_[middle].exact = true;
    return is_between;
  }

  /// All of the outline's own points take the samples' place.
  void take_all_points() {
    samples_.clear();
    for (std::size_t i = 0; i < contour_.points().size(); ++i) {
      samples_[contour_.arc_of(i)].exact = true;
    }
  }

  /// From each sample to the next; the last arc ends beyond the length.
  std::vector<std::array<double, 2>> arcs() const {
    std::vector<std::array<double, 2>> found;
    for (auto it = samples_.begin(); it != samples_.end(); ++it) {
      const auto next = std::next(it);
      found.push_back({it->first, next == samples_.end()
                                      ? samples_.begin()->first + contour_.length()
                                      : next->first});
    }
    return found;
  }

  Loop points() const {
    Loop loop;
    for (const auto& [s, sample] : samples_) loop.push_back(position(s, sample.exact));
    return loop;
  }

  Loop midpoints() const {
    Loop loop;
    for (const auto& [from, to] : arcs()) loop.push_back(position(0.5 * (from + to), false));
    return loop;
  }

  /// Index of the sample at s or of that nearest to it.
  int index_of(double s) const {
    auto best = samples_.begin();
    const auto after = samples_.lower_bound(s);
    const auto closer = [&](auto it) {
      if (contour_.distance_along(it->first, s) < contour_.distance_along(best->first, s)) {
        best = it;
      }
    };
    closer(std::prev(samples_.end()));
    if (after != samples_.end()) closer(after);
    if (after != samples_.begin()) closer(std::prev(after));
    return static_cast<int>(std::distance(samples_.begin(), best));
  }

 private:
  struct Sample {
    bool exact = false;  // on the outline itself, not on its smooth version
  };

  double key(double s) const { return s >= contour_.length() ? samples_.begin()->first : s; }
  void add(double s) { samples_.try_emplace(s >= contour_.length() ? s - contour_.length() : s); }
  Vector2d position(double s, bool exact) const {
    return on_grid(exact ? contour_.at(s) : contour_.smooth_at(s));
  }

  void refine(double from, double to) {
    const auto is_good = [&](double a, double b) {
      return follows_arc([&](double s) { return contour_.smooth_at(s); }, a, b,
                         spacing_(contour_.at(0.5 * (a + b))), kTolerance);
    };
    halve_arc(from, to, is_good, [&](double s) { add(s); });
  }

  const Contour& contour_;
  const Spacing& spacing_;
  std::map<double, Sample> samples_;
};

/// The points with the midpoint behind each.
Loop interleaved(const Loop& points, const Loop& midpoints) {
  Loop loop;
  for (std::size_t i = 0; i < points.size(); ++i) {
    loop.push_back(points[i]);
    loop.push_back(midpoints[i]);
  }
  return loop;
}

/// Divides the arcs that conflict; false when none could be.
bool divide_conflicting(std::vector<LoopSampler>& samplers,
                        const std::vector<std::array<LoopSide, 2>>& pairs, int sides_per_arc) {
  std::set<LoopSide> sides;
  for (const auto& pair : pairs) {
    for (const LoopSide& side : pair) sides.insert({side.loop, side.index / sides_per_arc});
  }
  bool changed = false;
  for (auto it = sides.begin(); it != sides.end();) {
    const int loop = it->loop;
    const auto arcs = samplers[loop].arcs();
    for (; it != sides.end() && it->loop == loop; ++it) {
      changed = samplers[loop].divide(arcs[it->index]) || changed;
    }
  }
  return changed;
}

std::vector<Loop> points_of(const std::vector<LoopSampler>& samplers) {
  std::vector<Loop> loops;
  for (const LoopSampler& s : samplers) loops.push_back(s.points());
  return loops;
}

bool keeps_signs(const std::vector<Loop>& loops, const std::vector<Contour>& contours) {
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (signed_area(loops[l]) * signed_area(contours[l].points()) <= 0) return false;
  }
  return true;
}

/// Makes the loops simple, disjoint and nested, with their midpoints where that is possible.
void repair(std::vector<LoopSampler>& samplers, const std::vector<Contour>& contours) {
  for (int round = 0; round < kRepairRounds; ++round) {
    const auto pairs = conflicts(points_of(samplers));
    if (!pairs.empty()) {
      if (!divide_conflicting(samplers, pairs, 1)) break;
      continue;
    }
    std::vector<Loop> bent;
    for (const LoopSampler& s : samplers) bent.push_back(interleaved(s.points(), s.midpoints()));
    const auto bent_pairs = conflicts(bent);
    if (bent_pairs.empty() || !divide_conflicting(samplers, bent_pairs, 2)) break;
  }
  for (const auto& [side, other] : conflicts(points_of(samplers))) {
    samplers[side.loop].take_all_points();
    samplers[other.loop].take_all_points();
  }
  const std::vector<Loop> loops = points_of(samplers);
  if (conflicts(loops).empty() && is_nested(loops) && keeps_signs(loops, contours)) return;
  for (LoopSampler& s : samplers) s.take_all_points();
}

}  // namespace

int OutlineSamples::steps_between(int p, int q) const {
  if (loop_of_point[p] != loop_of_point[q]) return -1;
  const int steps = std::abs(p - q);
  return std::min(steps, loop_size(loop_of_point[p]) - steps);
}

OutlineSamples sample_outline(const std::vector<Loop>& outline, const LatticeGraph& graph,
                              const Spacing& spacing, double width, double height) {
  std::vector<Contour> contours;
  for (const Loop& loop : outline) {
    contours.emplace_back(loop).find_marks(spacing, width, height);
  }
  std::vector<LoopSampler> samplers;
  for (const Contour& c : contours) samplers.emplace_back(c, spacing);

  struct Key {
    int loop = -1;
    double s = 0;
  };
  std::vector<Key> keys(graph.points.size());
  double mean_spacing = 0;
  for (const double s : graph.spacing) mean_spacing += s / graph.spacing.size();
  const CurveIndex index(segments_of(contours), std::max(2.0, mean_spacing));
  for (std::size_t p = 0; p < graph.points.size(); ++p) {
    const auto place = index.nearest(graph.points[p], kReach * graph.spacing[p]);
    if (!place) continue;
    keys[p] = {place->curve, samplers[place->curve].take(place->s, graph.spacing[p])};
  }
  for (LoopSampler& s : samplers) s.fill_gaps();
  repair(samplers, contours);

  OutlineSamples samples;
  samples.loop_begin.push_back(0);
  for (std::size_t l = 0; l < samplers.size(); ++l) {
    const Loop points = samplers[l].points(), midpoints = samplers[l].midpoints();
    samples.points.insert(samples.points.end(), points.begin(), points.end());
    samples.midpoints.insert(samples.midpoints.end(), midpoints.begin(), midpoints.end());
    samples.loop_of_point.resize(samples.points.size(), static_cast<int>(l));
    samples.loop_begin.push_back(static_cast<int>(samples.points.size()));
  }
  for (const Key& key : keys) {
    samples.sample_of_lattice_point.push_back(
        key.loop < 0 ? -1 : samples.loop_begin[key.loop] + samplers[key.loop].index_of(key.s));
  }
  return samples;
}

}  // namespace quadrille
