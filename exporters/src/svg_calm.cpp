#include "svg_calm.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace quadrille {
namespace {

/// Root mean square of what the best linear function of both parameters leaves of a patch's colour,
/// in 8-bit steps.
double bend(const BicubicHermite<Color>& color) {
  constexpr int n = 4;
  std::array<Eigen::Array3f, n * n> samples;
  Eigen::Array3f mean = Eigen::Array3f::Zero(), along_u = mean, along_v = mean;
  const auto place = [](int i) { return (i + 0.5f) / n - 0.5f; };
  float squares = 0;
  for (int i = 0; i < n * n; ++i) {
    const float u = place(i % n), v = place(i / n);
    samples[i] = 255 * color.at(0.5 + u, 0.5 + v).head<3>();
    mean += samples[i] / (n * n);
    along_u += samples[i] * u;
    along_v += samples[i] * v;
    squares += u * u;
  }
  float rest = 0;
  for (int i = 0; i < n * n; ++i) {
    const Eigen::Array3f linear =
        mean + (along_u * place(i % n) + along_v * place(i / n)) / squares;
    rest += (samples[i] - linear).square().sum();
  }
  return std::sqrt(rest / (3 * n * n));
}

}  // namespace

double banding_weight(const SvgLayer& layer, const std::vector<int>& quads) {
  static const double B0 = getenv("B0") ? atof(getenv("B0")) : 2, BP = getenv("BP") ? atof(getenv("BP")) : 0,
                      BM = getenv("BM") ? atof(getenv("BM")) : 4, BL = getenv("BL") ? atof(getenv("BL")) : 1;
  double sum = 0;
  for (const int q : quads) sum += bend(layer.color(q));
  const double mean = sum / std::max<std::size_t>(1, quads.size());
  if (getenv("BV")) fprintf(stderr, "bend %.3f of %d\n", mean, (int)quads.size());
  return std::clamp(std::pow(B0 / std::max(mean, 1e-6), BP), BL, BM);
}

}  // namespace quadrille
