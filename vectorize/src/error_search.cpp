#include "error_search.h"

#include <algorithm>
#include <cmath>

namespace quadrille {
namespace {

constexpr double kAccepted = 0.95;      // of the bound: no fewer quads are sought from there
constexpr double kSameNumber = 1.05;    // numbers closer than the mesh meets them
constexpr double kUsualExponent = 0.5;  // photographs from 1,000 to 10,000 quads: 0.4 to 0.7
constexpr double kLeastExponent = 0.15, kLargestExponent = 2;
constexpr double kLongestStep = 8;    // as a factor, without a point on the other side
constexpr double kInside = 0.15;      // share of the bracket that a step keeps from its ends
constexpr double kLeastError = 1e-3;  // that the logarithm sees

}  // namespace

void ErrorSearch::observe(int quads, double error) {
  const Point point{std::log(quads), std::log(std::max(error, kLeastError))};
  previous_ = last_;
  last_ = point;
  last_quads_ = quads;
  last_error_ = error;
  if (error > bound_) {
    if (!above_ || point.log_quads > above_->log_quads) above_ = point;
  } else if (!below_ || point.log_quads < below_->log_quads) {
    below_ = point;
  }
}

double ErrorSearch::target() const { return std::log((1 + kAccepted) / 2 * bound_); }

double ErrorSearch::predicted() const {
  const Point from = *last_;
  const std::optional<Point> other =
      above_ && below_ ? (last_error_ > bound_ ? below_ : above_) : previous_;
  double exponent = kUsualExponent;
  if (other && other->log_quads != from.log_quads) {
    exponent = std::clamp((from.log_error - other->log_error) / (other->log_quads - from.log_quads),
                          kLeastExponent, kLargestExponent);
  }
  return from.log_quads + (from.log_error - target()) / exponent;
}

std::optional<int> ErrorSearch::next() const {
  if (last_error_ <= bound_ && last_error_ >= kAccepted * bound_) return std::nullopt;
  double wished = predicted();
  if (above_ && below_) {
    const double width = below_->log_quads - above_->log_quads;
    if (width <= std::log(kSameNumber)) return std::nullopt;
    wished = std::clamp(wished, above_->log_quads + kInside * width,
                        below_->log_quads - kInside * width);
  } else {
    wished = std::clamp(wished, last_->log_quads - std::log(kLongestStep),
                        last_->log_quads + std::log(kLongestStep));
  }
  const double quads =
      std::clamp(std::round(std::exp(wished)), 1.0, static_cast<double>(max_quads_));
  const int number = static_cast<int>(quads);
  const bool known = std::log(number) == last_->log_quads ||
                     (above_ && std::log(number) <= above_->log_quads) ||
                     (below_ && std::log(number) >= below_->log_quads);
  if (known) return std::nullopt;
  return number;
}

}  // namespace quadrille
