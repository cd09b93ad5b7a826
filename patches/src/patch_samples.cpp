#include "patch_samples.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "patch_lanes.h"
#include "picture_sampling.h"

namespace quadrille {
namespace {

/// Finds the parameters of many pixel centres of one patch.
class PatchLocator {
 public:
  explicit PatchLocator(const BicubicHermite<Eigen::Vector2d>& geometry) : geometry_(geometry) {
    const NormalizedPatch normalized(geometry);
    origin_ = normalized.center.floor().cast<int>();
    const Eigen::Affine2d map =
        Eigen::Scaling(1 / normalized.size) *
        Eigen::Translation2d(origin_.cast<double>().matrix() - normalized.center.matrix());
    coefficients_ = geometry_coefficients(normalized, map);
  }

  /// Appends the parameters of the samples x_begin <= x < x_end of row y.
  void add_row(int y, int x_begin, int x_end, SampleBlock& block) {
    const float row = static_cast<float>(y - origin_.y()) + 0.5f;
    for (int x = x_begin; x < x_end; ++x) {
      x_[count_] = static_cast<float>(x - origin_.x()) + 0.5f;
      y_[count_] = row;
      if (++count_ == kBatch) flush(block);
    }
  }

  void flush(SampleBlock& block) {
    if (count_ == 0) return;
    const int padded = padded_count(count_);
    std::fill(x_ + count_, x_ + padded, x_[count_ - 1]);
    std::fill(y_ + count_, y_ + padded, y_[count_ - 1]);
    invert_lanes(coefficients_, {padded, x_, y_, u_, v_, found_});
    for (int i = 0; i < count_; ++i) {
      if (found_[i]) continue;
      if (!inverse_) inverse_.emplace(geometry_);
      const Eigen::Vector2d at =
          (*inverse_)(Eigen::Vector2d(x_[i], y_[i]) + origin_.cast<double>().matrix());
      u_[i] = static_cast<float>(at.x());
      v_[i] = static_cast<float>(at.y());
    }
    block.u.insert(block.u.end(), u_, u_ + count_);
    block.v.insert(block.v.end(), v_, v_ + count_);
    count_ = 0;
  }

 private:
  static constexpr int kBatch = 64;

  const BicubicHermite<Eigen::Vector2d>& geometry_;
  GeometryCoefficients coefficients_;
  Eigen::Array2i origin_;
  std::optional<PatchInverse> inverse_;  // made when first needed
  int count_ = 0;
  alignas(64) float x_[kBatch], y_[kBatch], u_[kBatch], v_[kBatch];
  alignas(64) int found_[kBatch];
};

bool on_outline(float u, float v) { return u <= 0 || u >= 1 || v <= 0 || v >= 1; }

}  // namespace

SampleBlock find_samples(const PatchMesh& patches, const PatchScan& scan, const Raster& picture,
                         int block) {
  const int first = block * kSampleBlock;
  const int last = std::min(first + kSampleBlock, patches.patch_count());
  SampleBlock samples;
  samples.first_patch = first;
  samples.begin.push_back(0);
  for (int q = first; q < last; ++q) {
    const SampleWindow window = intersection(scan.bounds(q), {0, 0, picture.width, picture.height});
    if (!window.empty()) {
      const auto geometry = patch_geometry(patches, q);
      const auto picture_at = [&](double u, double v) -> Color {
        return sample_bilinear(picture, geometry.at(u, v)).cast<float>();
      };
      const std::size_t before = samples.pixel.size();
      PatchLocator locator(geometry);
      scan.scan(q, window, [&](int y, int x_begin, int x_end) {
        locator.add_row(y, x_begin, x_end, samples);
        const auto row = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(picture.width);
        for (int x = x_begin; x < x_end; ++x) samples.pixel.push_back(row + x);
      });
      locator.flush(samples);
      // The outline is scanned as a polyline, so a centre may lie a little outside the curve; then
      // the picture counts at the nearest point of the patch.
      for (std::size_t i = before; i < samples.pixel.size(); ++i) {
        if (!on_outline(samples.u[i], samples.v[i])) continue;
        samples.exceptions.push_back({i, picture_at(samples.u[i], samples.v[i])});
      }
    }
    samples.begin.push_back(samples.pixel.size());
  }
  return samples;
}

}  // namespace quadrille
