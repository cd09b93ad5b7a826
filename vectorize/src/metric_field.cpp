#include "metric_field.h"

#include <algorithm>

namespace quadrille {

CoarseMetric::CoarseMetric(const CrossField& field, const FieldGrid<AxisPair>& fine, int factor)
    : factor(factor) {
  const int w = (fine.width + factor - 1) / factor, h = (fine.height + factor - 1) / factor;
  z = FieldGrid<std::complex<float>>(w, h);
  angle = FieldGrid<float>(w, h);
  lengths = FieldGrid<AxisPair>(w, h);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      std::complex<float> cross = 0;
      MetricTensor sum;
      int count = 0;
      for (int j = y * factor; j < std::min(fine.height, (y + 1) * factor); ++j) {
        for (int i = x * factor; i < std::min(fine.width, (x + 1) * factor); ++i) {
          const std::complex<float> here = field.z(i, j);
          cross += here;
          sum.add(1, MetricTensor(fine(i, j), std::polar(1.0f, 0.25f * std::arg(here))));
          ++count;
        }
      }
      const float size = std::abs(cross);
      z(x, y) = size > 1e-6f ? cross / size : std::complex<float>(1);
      angle(x, y) = 0.25f * std::arg(z(x, y));
      const AxisPair total = sum.along(std::polar(1.0f, angle(x, y)));
      lengths(x, y) = {total.x / count, total.y / count};
    }
  }
}

FieldGrid<MetricTensor> CoarseMetric::tensors() const {
  FieldGrid<MetricTensor> result(z.width, z.height);
  for (std::size_t i = 0; i < result.data.size(); ++i) {
    result.data[i] = MetricTensor(lengths.data[i], std::polar(1.0f, angle.data[i]));
  }
  return result;
}

MetricTensor interpolated(const FieldGrid<MetricTensor>& tensors, int factor, int x, int y) {
  const float u = (x + 0.5f) / factor - 0.5f, v = (y + 0.5f) / factor - 0.5f;
  const int i = std::clamp(static_cast<int>(std::floor(u)), 0, std::max(0, tensors.width - 2));
  const int j = std::clamp(static_cast<int>(std::floor(v)), 0, std::max(0, tensors.height - 2));
  const float fu = std::clamp(u - i, 0.0f, 1.0f), fv = std::clamp(v - j, 0.0f, 1.0f);
  MetricTensor mean;
  for (int k = 0; k < 4; ++k) {
    const int cx = std::min(i + (k & 1), tensors.width - 1);
    const int cy = std::min(j + (k >> 1), tensors.height - 1);
    mean.add((k & 1 ? fu : 1 - fu) * (k >> 1 ? fv : 1 - fv), tensors(cx, cy));
  }
  return mean;
}

}  // namespace quadrille
