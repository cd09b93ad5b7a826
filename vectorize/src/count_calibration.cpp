#include "count_calibration.h"

#include <algorithm>
#include <cmath>

namespace quadrille {
namespace {

constexpr double kLongestStep = 0.7;     // of the logarithm, where no trial is on the other side
constexpr double kFromEnds = 0.15;       // of a bracket is left out at either end
constexpr double kSmallestStep = 0.004;  // trials closer than this give the same mesh

}  // namespace

CountCalibration::CountCalibration(int wished, double first_guess)
    : log_wished_(std::log(wished)), cells_(first_guess) {}

void CountCalibration::observe(int quads) {
  trials_.push_back({std::log(cells_), std::log(std::max(1, quads))});
  cells_ = std::max(0.25, std::exp(apart_from_trials(next_guess())));
}

/// Between the nearest trials with too few and too many quads, as far as they are in order; else
/// where the median trial's quads per cell would give the wished number.
double CountCalibration::next_guess() const {
  const Trial *few = nullptr, *many = nullptr;
  std::vector<double> gains;
  for (const Trial& t : trials_) {
    if (t.log_quads < log_wished_ && (!few || t.log_cells > few->log_cells)) few = &t;
    if (t.log_quads >= log_wished_ && (!many || t.log_cells < many->log_cells)) many = &t;
    gains.push_back(t.log_quads - t.log_cells);
  }
  if (few && many && few->log_cells < many->log_cells) {
    const double share = (log_wished_ - few->log_quads) / (many->log_quads - few->log_quads);
    return few->log_cells +
           std::clamp(share, kFromEnds, 1 - kFromEnds) * (many->log_cells - few->log_cells);
  }
  const auto median = gains.begin() + static_cast<std::ptrdiff_t>(gains.size() / 2);
  std::ranges::nth_element(gains, median);
  const double last = trials_.back().log_cells;
  return last + std::clamp(log_wished_ - *median - last, -kLongestStep, kLongestStep);
}

/// The nearest place to a guess, by growing steps to either side, that was not tried yet.
double CountCalibration::apart_from_trials(double guess) const {
  const auto is_tried = [&](double place) {
    return std::ranges::any_of(
        trials_, [&](const Trial& t) { return std::abs(t.log_cells - place) < kSmallestStep; });
  };
  double step = 0;
  while (is_tried(guess + step)) step = step > 0 ? -step : -step + kSmallestStep;
  return guess + step;
}

}  // namespace quadrille
