#include "inkscape_slopes.h"

#include <algorithm>
#include <cmath>

namespace quadrille {

void NodeLine::add(const Eigen::Vector2d& position, const Color& color) {
  if (!positions_.empty()) {
    lengths_.push_back(static_cast<float>((position - positions_.back()).norm()));
  }
  positions_.push_back(position);
  colors_.push_back(color.cwiseMax(0.0f).cwiseMin(1.0f));
}

std::vector<Color> NodeLine::slopes() const {
  const std::size_t last = colors_.size() - 1;
  std::vector<Color> result(colors_.size(), Color::Zero());
  for (std::size_t i = 1; i < last; ++i) result[i] = inner_slope(i);
  result.front() = 2 * chord_slope(0) - result[1];
  result.back() = 2 * chord_slope(last - 1) - result[last - 1];
  return result;
}

Color NodeLine::between(std::size_t i, double t, const std::vector<Color>& slopes) const {
  const std::array<double, 4> basis = hermite_basis(t);
  const auto weight = [&](int k) { return static_cast<float>(basis[k]); };
  const Color color = colors_[i] * weight(0) + slopes[i] * (weight(1) * lengths_[i]) +
                      colors_[i + 1] * weight(2) + slopes[i + 1] * (weight(3) * lengths_[i]);
  return color.cwiseMax(0.0f).cwiseMin(1.0f);
}

Color NodeLine::chord_slope(std::size_t i) const {
  if (lengths_[i] <= 0) return Color::Zero();
  return (colors_[i + 1] - colors_[i]) / lengths_[i];
}

Color NodeLine::inner_slope(std::size_t i) const {
  const Color before = chord_slope(i - 1), after = chord_slope(i);
  Color slope = 0.5f * (before + after);
  for (int c = 0; c < 4; ++c) {
    if (before[c] * after[c] < 0) slope[c] = 0;
    for (const float chord : {before[c], after[c]}) {
      if (std::abs(slope[c]) > 3 * std::abs(chord)) slope[c] = 3 * chord;
    }
  }
  return slope;
}

}  // namespace quadrille
