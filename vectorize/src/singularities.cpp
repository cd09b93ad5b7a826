#include <cmath>
#include <numbers>

#include "quadrille/cross_field.h"

namespace quadrille {
namespace {

using Complex = std::complex<float>;

/// The period jump of Eq. 2 between neighbours: round((arg b - arg a) / 2 pi). It is not 0 when the
/// shorter way from a to b crosses the negative real axis.
int period_jump(Complex a, Complex b) {
  const bool a_below = a.imag() < 0, b_below = b.imag() < 0;
  if (a_below == b_below) return 0;
  const float cross = a.real() * b.imag() - a.imag() * b.real();
  if (a_below) return cross < 0 ? 1 : 0;
  return cross > 0 ? -1 : 0;
}

}  // namespace

std::vector<Singularity> singularities(const CrossField& field) {
  const auto& z = field.z;
  std::vector<Singularity> found;
  std::vector<int> above(z.width), below(z.width);  // jumps to the right along two rows
  const auto jumps_along = [&](int y, std::vector<int>& jumps) {
    for (int x = 0; x + 1 < z.width; ++x) jumps[x] = period_jump(z(x, y), z(x + 1, y));
  };
  if (z.height > 0) jumps_along(0, above);
  for (int y = 0; y + 1 < z.height; ++y) {
    jumps_along(y + 1, below);
    int left = period_jump(z(0, y), z(0, y + 1));
    for (int x = 0; x + 1 < z.width; ++x) {
      const int right = period_jump(z(x + 1, y), z(x + 1, y + 1));
      const int index = left + below[x] - right - above[x];
      if (index != 0) found.push_back({x + 1.0, y + 1.0, index});
      left = right;
    }
    std::swap(above, below);
  }
  return found;
}

double misalignment_degrees(const CrossField& field, const FeatureTensor& features) {
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < field.z.data.size(); ++i) {
    if (!features.edges.data[i]) continue;
    const double w = features.weight.data[i];
    sum += w * std::abs(std::arg(field.z.data[i] * std::conj(features.direction.data[i]))) / 4;
    weight += w;
  }
  return weight > 0 ? sum / weight * 180 / std::numbers::pi : 0;
}

}  // namespace quadrille
