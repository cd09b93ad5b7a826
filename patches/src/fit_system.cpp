#include "fit_system.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit_lanes.h"
#include "fit_smoothness.h"
#include "parallel_ranges.h"
#include "patch_samples.h"
#include "picture_sampling.h"

namespace quadrille {
namespace {

/// Damping of what a mixture leaves open, beside that of every square pixel: else slivers between
/// tears would take any colour to explain their pixels.
constexpr double kOpenWeight = 300;
constexpr double kBlockFloor = 1e-5;  // relative to a unit diagonal

/// Adds the samples of the block's patch number `local` to the sums.
void add_samples(const SampleBlock& samples, int local, const Raster& picture,
                 const MixedPixels& mixed, const ControlColors& model, FitSums& sums) {
  FitBatch batch;
  const std::size_t last = samples.begin[local + 1];
  auto exception = std::lower_bound(
      samples.exceptions.begin(), samples.exceptions.end(), samples.begin[local],
      [](const SampleBlock::Exception& e, std::size_t sample) { return e.sample < sample; });
  for (std::size_t first = samples.begin[local]; first < last; first += FitBatch::kSize) {
    const int count = static_cast<int>(std::min<std::size_t>(FitBatch::kSize, last - first));
    batch.count = padded_count(count);
    for (int i = 0; i < batch.count; ++i) {
      const std::size_t sample = first + std::min(i, count - 1);
      batch.u[i] = samples.u[sample];
      batch.v[i] = samples.v[sample];
      const std::uint32_t pixel = samples.pixel[sample];
      batch.weight[i] = i < count && !mixed.contains(pixel) ? 1.0f : 0.0f;
      batch.color[i] = premultiplied_pixel(picture, pixel);
    }
    for (; exception != samples.exceptions.end() && exception->sample < first + count;
         ++exception) {
      batch.color[exception->sample - first] = exception->color;
    }
    add_batch(model, picture.channels, batch, sums);
  }
}

PatchScan pixel_scan(const PatchMesh& patches) {
  std::vector<int> all(patches.patch_count());
  std::iota(all.begin(), all.end(), 0);
  PatchScan scan(patches);
  scan.start(Eigen::Affine2d::Identity());
  scan.add(all, [](std::size_t count, const auto& body) {
    tbb::parallel_for(std::size_t{0}, count, body);
  });
  return scan;
}

WedgeUnknowns unknowns_of(const Wedge& w) {
  WedgeUnknowns x;
  x.col(0) = w.value;
  x.col(1) = w.dx;
  x.col(2) = w.dy;
  x.col(3) = w.twist;
  return x;
}

}  // namespace

void control_colors(const PatchMesh& patches, int q, const std::array<CornerMap, 4>& corners,
                    ControlColors& control) {
  CornerUnknowns x;
  for (int k = 0; k < 4; ++k) {
    x[k] = unknowns_of(patches.wedges[patches.wedge_of_corner[4 * q + k]]);
  }
  const BicubicBezier<Color> bezier = colors_of(corners, x);
  for (int k = 0; k < 16; ++k) {
    for (int c = 0; c < 4; ++c) control[c][k] = bezier.control[k / 4][k % 4][c];
  }
}

void add_correction(const ColorSystem::Vector& correction, std::vector<Wedge>& wedges) {
  for_each_range(static_cast<int>(wedges.size()), [&](int begin, int end) {
    for (int w = begin; w < end; ++w) {
      wedges[w].value += correction[w].col(0).array();
      wedges[w].dx += correction[w].col(1).array();
      wedges[w].dy += correction[w].col(2).array();
      wedges[w].twist += correction[w].col(3).array();
    }
  });
}

ColorSystem::ColorSystem(const PatchMesh& patches, const Raster& picture, const FitOptions& options,
                         const RunContext& context, std::vector<SampleBlock>* keep,
                         const Overshoot& overshoot)
    : ColorSystem(pixel_scan(patches), picture, options, context, keep, overshoot) {}

ColorSystem::ColorSystem(const PatchScan& scan, const Raster& picture, const FitOptions& options,
                         const RunContext& context, std::vector<SampleBlock>* keep,
                         const Overshoot& overshoot)
    : channels_(picture.channels),
      wedge_corners_(scan.patches()),
      mixed_(scan, picture, rows_),
      groups_(padded_count(scan.patches().patch_count()) / kLaneCount),
      scratch_(padded_count(scan.patches().patch_count())),
      inverse_blocks_(scan.patches().wedges.size()) {
  const PatchMesh& patches = scan.patches();
  right_hand_side.resize(patches.wedges.size());
  if (options.smoothness > 0) add_smoothness(patches, options.smoothness, rows_);
  overshoot.add_equations(patches, rows_);
  rows_.finish(patches.wedges.size());
  assemble(scan, picture, options.regularization, context, keep);
  rows_.evaluate_residual();
  for_each_range(wedge_count(), [&](int begin, int end) {
    for (int w = begin; w < end; ++w) {
      right_hand_side[w].setZero();
      for (const int h : wedge_corners_[w]) right_hand_side[w] += scratch_[h >> 2][h & 3];
      rows_.gather(w, right_hand_side[w]);
    }
  });
  invert_blocks();
}

void ColorSystem::assemble(const PatchScan& scan, const Raster& picture, double regularization,
                           const RunContext& context, std::vector<SampleBlock>* keep) {
  context.progress("fit", 0);
  const PatchMesh& patches = scan.patches();
  const bool are_known = keep && !keep->empty();
  if (keep) keep->resize(sample_block_count(patches));
  tbb::parallel_for(0, sample_block_count(patches), [&](int block) {
    SampleBlock here;
    SampleBlock& samples = keep ? (*keep)[block] : here;
    if (!are_known) samples = find_samples(patches, scan, picture, block);
    for (int local = 0; local < samples.patch_count(); ++local) {
      const int q = samples.first_patch + local;
      const std::array<CornerMap, 4> corners = corner_maps(patches, q);
      ControlColors model;
      control_colors(patches, q, corners, model);
      FitSums sums{};
      const double area = std::abs(quad_area(patches.mesh, q));
      const auto damping =
          uniform_moments(regularization * (area + kOpenWeight * mixed_.open_area(q)));
      std::copy(damping.begin(), damping.end(), sums.moments);
      add_samples(samples, local, picture, mixed_, model, sums);
      groups_[q / kLaneCount].set(q % kLaneCount, corners, sums.moments,
                                  &patches.wedge_of_corner[4 * q]);
      BicubicBezier<Color> gradient;
      for (int k = 0; k < 16; ++k) {
        for (int c = 0; c < 4; ++c) {
          gradient.control[k / 4][k % 4][c] = static_cast<float>(sums.residual[c][k]);
        }
      }
      scratch_[q] = transpose_of(corners, gradient);
    }
  });
  context.progress("fit", 0.5);
}

template <class Body>
void ColorSystem::for_each_group(const Body& body) {
  for_each_range(static_cast<int>(groups_.size()), [&](int begin, int end) {
    for (int g = begin; g < end; ++g) body(g);
  });
}

void ColorSystem::invert_blocks() {
  for_each_group([&](int g) { diagonal_blocks(groups_[g], &scratch_[g * kLaneCount]); });
  for_each_range(wedge_count(), [&](int begin, int end) {
    for (int w = begin; w < end; ++w) {
      Eigen::Matrix4d block = rows_.block(w);
      for (const int h : wedge_corners_[w]) block += scratch_[h >> 2][h & 3].cast<double>();
      // Unit diagonal first: the four unknowns differ by powers of the edge length.
      // Patches without an area leave their unknowns as they are.
      const Eigen::Vector4d scale =
          block.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0.0; });
      Eigen::Matrix4d scaled = scale.asDiagonal() * block * scale.asDiagonal();
      // Keeps the preconditioner positive definite where rounding of the element products does not.
      scaled.diagonal().array() += kBlockFloor;
      inverse_blocks_[w] =
          (scale.asDiagonal() * scaled.inverse() * scale.asDiagonal()).cast<float>();
    }
  });
}

Eigen::Array4d ColorSystem::multiply(const Vector& x, Vector& product) {
  for_each_group([&](int g) {
    quadrille::multiply(groups_[g], channels_, x.data(), &scratch_[g * kLaneCount]);
  });
  return gather(x, scratch_, product);
}

Eigen::Array4d ColorSystem::gather(const Vector& x, const std::vector<CornerUnknowns>& shares,
                                   Vector& product) {
  rows_.evaluate(x);
  return sum_over_ranges(wedge_count(), Eigen::Array4d(0, 0, 0, 0), [&](int begin, int end) {
    Eigen::Array4d sum = Eigen::Array4d::Zero();
    for (int w = begin; w < end; ++w) {
      product[w].setZero();
      for (const int h : wedge_corners_[w]) product[w] += shares[h >> 2][h & 3];
      rows_.gather(w, product[w]);
      sum += x[w].cwiseProduct(product[w]).rowwise().sum().array().cast<double>();
    }
    return sum;
  });
}

}  // namespace quadrille
