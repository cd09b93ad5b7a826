#include "svg_calm.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace quadrille {
namespace {

/// In 8-bit steps, of photographs; its power gives the weight, within bounds.
constexpr double kUsualBend = 6, kExponent = 0.7, kLeastWeight = 0.83, kMostWeight = 4;

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

double banding_weight(const SvgLayer& layer) {
  double sum = 0;
  int count = 0;
  for (int q = 0; q < layer.mesh().quad_count(); ++q) {
    if (layer.opacity(q) == PatchOpacity::transparent) continue;
    sum += bend(layer.color(q));
    ++count;
  }
  if (count == 0) return 1;
  return std::clamp(std::pow(kUsualBend * count / sum, kExponent), kLeastWeight, kMostWeight);
}

}  // namespace quadrille
