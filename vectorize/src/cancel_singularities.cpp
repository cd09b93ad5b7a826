#include "cancel_singularities.h"

#include <algorithm>
#include <cmath>

#include "dual_path.h"

namespace quadrille {
namespace {

// Later rounds pair what the cheaper pairs of earlier ones left without a partner.
constexpr int kRounds = 4;
// A window reaches beyond its path by this many pixels and this share of the path's extent: far
// enough that widening it lowers the energy no further worth the time.
constexpr int kMargin = 3;
constexpr double kMarginShare = 0.3;
// Around a single singularity, and the steps that it may make.
constexpr int kStepMargin = 6;
constexpr int kMaxSteps = 4;
// A step must gain this much energy, or rounding errors could send a singularity to and fro.
constexpr double kLeastGain = 1e-3;

/// The plaquettes whose index depends on pixels of the window.
template <class Visit>
void for_plaquettes(const Window& w, const IndexGrid& indices, const Visit& visit) {
  for (int y = std::max(w.y0 - 1, 0); y < std::min(w.y1, indices.height); ++y) {
    for (int x = std::max(w.x0 - 1, 0); x < std::min(w.x1, indices.width); ++x) visit(x, y);
  }
}

struct Outcome {
  double rise = 0;    ///< of the energy
  int cancelled = 0;  ///< singularities fewer than before
};

class Canceller {
 public:
  Canceller(AngleField& field, const CancelOptions& options, const RunContext& context)
      : field_(field),
        options_(options),
        context_(context),
        indices_(field.turns.width - 1, field.turns.height - 1),
        changed_(field.turns.width, field.turns.height) {
    update_indices(whole());
  }

  void cancel_pairs() {
    DualPathFinder finder(field_, indices_, options_.radius);
    std::vector<Window> altered = {whole()};
    for (int round = 0; round < kRounds && !altered.empty(); ++round) {
      std::vector<Window> solved;
      for (const DualPath& path : cheapest_first(finder)) {
        context_.progress("cross field", kProgress);
        const Window window = around(path);
        const bool fresh = std::ranges::any_of(
            altered, [&](const Window& other) { return other.overlaps(window); });
        const bool there = indices_(path.from.x, path.from.y) * indices_(path.to.x, path.to.y) < 0;
        if (!fresh || !there) continue;
        const bool kept = attempt(window, path.jumps, [&](const Outcome& outcome) {
          return outcome.cancelled > 0 && outcome.rise < options_.allowance * outcome.cancelled;
        });
        if (kept) solved.push_back(window);
      }
      altered = std::move(solved);
    }
  }

  void move_single() {
    std::vector<Plaquette> left;
    for_plaquettes(whole(), indices_, [&](int x, int y) {
      if (indices_(x, y) != 0) left.push_back({x, y});
    });
    for (Plaquette at : left) {
      context_.progress("cross field", kProgress);
      // The angles alone first, so that a step has to pay for itself.
      attempt(around(at), {}, [](const Outcome& o) { return o.rise < 0 && o.cancelled >= 0; });
      for (int step = 0; step < kMaxSteps && indices_(at.x, at.y) != 0 && step_from(at); ++step) {
      }
    }
  }

  FieldGrid<unsigned char> take_changed() { return std::move(changed_); }

 private:
  static constexpr double kProgress = 0.8;

  AngleField& field_;
  CancelOptions options_;
  const RunContext& context_;
  IndexGrid indices_;
  FieldGrid<unsigned char> changed_;
  std::vector<float> saved_;

  Window whole() const { return {0, 0, field_.turns.width, field_.turns.height}; }

  Window grown(const Window& w, int margin) const {
    return {std::max(w.x0 - margin, 0), std::max(w.y0 - margin, 0),
            std::min(w.x1 + margin, field_.turns.width),
            std::min(w.y1 + margin, field_.turns.height)};
  }

  Window around(const Plaquette& at) const {
    return grown({at.x, at.y, at.x + 2, at.y + 2}, kStepMargin);
  }

  Window around(const DualPath& path) const {
    Window w{path.to.x, path.to.y, path.to.x + 2, path.to.y + 2};
    for (const JumpChange& jump : path.jumps) {
      w = {std::min(w.x0, jump.x), std::min(w.y0, jump.y), std::max(w.x1, jump.x + 2),
           std::max(w.y1, jump.y + 2)};
    }
    return grown(w, kMargin + static_cast<int>(kMarginShare * std::max(w.width(), w.height())));
  }

  std::vector<DualPath> cheapest_first(DualPathFinder& finder) const {
    std::vector<DualPath> paths;
    for (int y = 0; y < indices_.height; ++y) {
      for (int x = 0; x < indices_.width; ++x) {
        if (indices_(x, y) <= 0) continue;
        if (auto path = finder.nearest_opposite({x, y})) paths.push_back(*std::move(path));
      }
    }
    std::ranges::stable_sort(paths, {}, &DualPath::cost);
    return paths;
  }

  /// Across the edge where the angles lean most, as in line 7 of Alg. 1.
  bool step_from(Plaquette& at) {
    const int quarter = indices_(at.x, at.y) > 0 ? 1 : -1;
    Plaquette target = at;
    JumpChange jump;
    float least = 0;
    for (int direction = 0; direction < 4; ++direction) {
      const Plaquette next = neighbour(at, direction);
      if (!contains(indices_, next)) continue;
      const JumpChange crossed = crossing(at, direction, quarter);
      const float cost = crossing_cost(field_, crossed);
      if (target == at || cost < least) target = next, jump = crossed, least = cost;
    }
    if (target == at) return false;
    const bool kept = attempt(around(at), {&jump, 1}, [](const Outcome& outcome) {
      return outcome.cancelled >= 0 && outcome.rise < -kLeastGain;
    });
    if (kept) at = target;
    return kept;
  }

  /// Changes the jumps, solves for the angles, and takes it back unless `acceptable`.
  template <class Acceptable>
  bool attempt(const Window& window, std::span<const JumpChange> jumps,
               const Acceptable& acceptable) {
    save_turns(window);
    const double energy_before = energy(field_, window);
    const int count_before = count(window);
    solve_window(field_, window, jumps, context_);
    update_indices(window);
    const Outcome outcome{energy(field_, window) - energy_before, count_before - count(window)};
    if (acceptable(outcome)) {
      for (int y = window.y0; y < window.y1; ++y) {
        std::fill_n(&changed_(window.x0, y), window.width(), 1);
      }
      return true;
    }
    restore_turns(window);
    update_indices(window);
    return false;
  }

  void update_indices(const Window& window) {
    for_plaquettes(window, indices_, [&](int x, int y) {
      indices_(x, y) = static_cast<signed char>(quarter_index(field_.turns, x, y));
    });
  }

  int count(const Window& window) const {
    int sum = 0;
    for_plaquettes(window, indices_, [&](int x, int y) { sum += std::abs(indices_(x, y)); });
    return sum;
  }

  void save_turns(const Window& w) {
    saved_.clear();
    for (int y = w.y0; y < w.y1; ++y) {
      const float* row = &field_.turns(w.x0, y);
      saved_.insert(saved_.end(), row, row + w.width());
    }
  }

  void restore_turns(const Window& w) {
    for (int y = w.y0; y < w.y1; ++y) {
      const auto row = saved_.begin() + static_cast<std::ptrdiff_t>(y - w.y0) * w.width();
      std::copy_n(row, w.width(), &field_.turns(w.x0, y));
    }
  }
};

}  // namespace

FieldGrid<unsigned char> cancel_singularities(AngleField& field, const CancelOptions& options,
                                              const RunContext& context) {
  if (field.turns.width < 2 || field.turns.height < 2) {
    return FieldGrid<unsigned char>(field.turns.width, field.turns.height);
  }
  Canceller canceller(field, options, context);
  canceller.cancel_pairs();
  canceller.move_single();
  return canceller.take_changed();
}

}  // namespace quadrille
