#include "fitted_state.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "fit_solver.h"
#include "picture_sampling.h"
#include "quadrille/patch_geometry.h"

namespace quadrille {

FittedState::FittedState(PatchMesh start, const Raster& picture, const FitOptions& fit_options,
                         const RunContext& context, std::vector<SampleBlock> known)
    : patches(std::move(start)),
      samples(std::move(known)),
      colors(patches, picture, fit_options, context, &samples) {
  correction_.assign(patches.wedges.size(), WedgeUnknowns::Zero());
  improve(picture, fit_options, context);
}

void FittedState::improve(const Raster& picture, const FitOptions& options,
                          const RunContext& context) {
  solve(options, context);
  show(picture);
}

float FittedState::squared_error_at(const Raster& picture, std::size_t pixel) const {
  const Color residual = 2 * (premultiplied_pixel(picture, pixel) - mean[pixel]);
  float squares = 0;
  for (int c = 0; c < picture.channels; ++c) squares += residual[c] * residual[c];
  return squares;
}

/// The solver leaves the rest of the right-hand side in the system, for the next correction.
void FittedState::solve(const FitOptions& options, const RunContext& context) {
  const ColorSystem::Vector step = quadrille::solve(colors, options, context, fit);
  add_correction(step, patches.wedges);
  for (std::size_t w = 0; w < step.size(); ++w) correction_[w] += step[w];
}

void FittedState::show(const Raster& picture) {
  squared_error = roughness = 0;
  mean.resize(static_cast<std::size_t>(picture.width) * picture.height);
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = premultiplied_pixel(picture, i);
  std::vector<double> errors(samples.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t b) {
    for (int local = 0; local < samples[b].patch_count(); ++local) {
      errors[b] += show_patch(samples[b], local, picture.channels);
    }
  });
  for (const double e : errors) squared_error += e;
  const std::vector<std::size_t>& mixed = colors.mixed_pixels().pixels();
  for (std::size_t row = 0; row < colors.rows().size(); ++row) {
    const Eigen::Vector4f rest = colors.rows().rest(row, correction_);
    if (row >= mixed.size()) {
      roughness += static_cast<double>(rest.squaredNorm());
      continue;
    }
    const Color given = premultiplied_pixel(picture, mixed[row]);
    for (int c = 0; c < picture.channels; ++c) {
      float& between = mean[mixed[row]][c];
      const double at_center = 2 * (given[c] - between), now = rest[c];
      squared_error += now * now - at_center * at_center;
      between = given[c] - 0.5f * rest[c];
    }
  }
}

double FittedState::show_patch(const SampleBlock& block, int local, int channels) {
  const int q = block.first_patch + local;
  ControlColors model;
  control_colors(patches, q, corner_maps(patches, q), model);
  double error = 0;
  const std::size_t last = block.begin[local + 1];
  for (std::size_t first = block.begin[local]; first < last; first += FitBatch::kSize) {
    const int count = static_cast<int>(std::min<std::size_t>(FitBatch::kSize, last - first));
    alignas(64) float u[FitBatch::kSize] = {}, v[FitBatch::kSize] = {}, shown[4][FitBatch::kSize];
    std::copy_n(block.u.data() + first, count, u);
    std::copy_n(block.v.data() + first, count, v);
    evaluate_batch(model, channels, padded_count(count), u, v, shown);
    for (int i = 0; i < count; ++i) {
      Color& between = mean[block.pixel[first + i]];
      float squares = 0;
      for (int c = 0; c < channels; ++c) {
        const float residual = between[c] - shown[c][i];
        squares += residual * residual;
        between[c] -= 0.5f * residual;
      }
      error += static_cast<double>(squares);
    }
  }
  return error;
}

}  // namespace quadrille
