#include "pdf_cells.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace quadrille {
namespace {

/// Cells are not made shorter than this, in pixels of the picture.
constexpr double kSmallestSide = 1;
constexpr int kCounts[] = {1, 2, 3, 4, 6, 8, 12, 24};
constexpr int kCountCount = static_cast<int>(std::size(kCounts));
/// Added before colours are cut off to whole steps. MuPDF and Ghostscript cut off the colours of
/// pixels in turn, which darkens them by half a step, and pdf.js does so twice; poppler rounds.
/// This lies between. More cells would not mend what it adds to colours in the mean, except to
/// white, from which nothing is cut off.
constexpr float kRounding = 0.875f, kAdded = kRounding - 0.5f;
/// Counts below this index are fitted to the coarse samples, all of them to the fine ones.
constexpr int kCoarseCounts = 6, kCoarseSamples = 24 + 2, kFineSamples = 72 + 2;

using Samples = Eigen::MatrixXf;  ///< (u, v)

/// Sample `s` of the ends of [0, 1] and the middles of equal parts.
double sample_position(int s, int samples) {
  return std::clamp((s - 0.5) / (samples - 2), 0.0, 1.0);
}

/// Piecewise linear functions over `count` equal parts of [0, 1], at the samples.
struct HatBasis {
  Eigen::MatrixXf hats;         ///< (sample, node)
  Eigen::MatrixXf fit;          ///< samples to nodes, least squares
  Eigen::MatrixXf orthonormal;  ///< of the same span

  HatBasis(int samples, int count) {
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(samples, count + 1);
    for (int s = 0; s < samples; ++s) {
      const double t = sample_position(s, samples) * count;
      const int cell = std::min(static_cast<int>(t), count - 1);
      h(s, cell) = 1 - (t - cell);
      h(s, cell + 1) = t - cell;
    }
    const Eigen::LLT<Eigen::MatrixXd> factors(h.transpose() * h);
    hats = h.cast<float>();
    fit = factors.solve(h.transpose()).cast<float>();
    orthonormal = factors.matrixL().solve(h.transpose()).transpose().cast<float>();
  }
};

/// The points in which a patch is looked at, and what is fitted there.
struct SampleGrid {
  Eigen::MatrixXf bernstein;  ///< (sample, polynomial)
  std::vector<HatBasis> hats;

  SampleGrid(int samples, int counts) : bernstein(samples, 4) {
    for (int s = 0; s < samples; ++s) {
      const float t = static_cast<float>(sample_position(s, samples)), r = 1 - t;
      bernstein.row(s) << r * r * r, 3 * r * r * t, 3 * r * t * t, t * t * t;
    }
    for (int i = 0; i < counts; ++i) hats.emplace_back(samples, kCounts[i]);
  }
};

const SampleGrid& coarse_grid() {
  static const SampleGrid grid(kCoarseSamples, kCoarseCounts);
  return grid;
}

const SampleGrid& fine_grid() {
  static const SampleGrid grid(kFineSamples, kCountCount);
  return grid;
}

/// What the cells are to show, in 8-bit steps.
struct Target {
  std::array<Samples, 3> channel;
  int channels = 3;
  Samples weight;
  bool weighted = false;
};

std::array<Samples, 4> sampled(const SampleGrid& grid, const BicubicBezier<Color>& color,
                               bool opaque) {
  std::array<Samples, 4> samples;
  for (int c = 0; c < (opaque ? 3 : 4); ++c) {
    Eigen::Matrix4f control;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) control(i, j) = color.control[j][i][c];
    }
    samples[c] =
        (grid.bernstein * control * grid.bernstein.transpose()).cwiseMax(0.0f).cwiseMin(1.0f);
  }
  if (opaque) samples[3].setOnes(samples[0].rows(), samples[0].cols());
  return samples;
}

/// Straight colour. Where there is next to no alpha it goes over into the patch's mean colour:
/// nobody sees it, but the fit would follow it.
void set_straight(Target& target, const std::array<Samples, 4>& samples) {
  constexpr float kFaint = 0.02f;
  const auto alpha = samples[3].array();
  const float all = std::max(alpha.sum(), 1e-3f);
  for (int c = 0; c < 3; ++c) {
    const float mean = std::min(samples[c].sum() / all, 1.0f);
    const auto share = kFaint * (1 - alpha).square();
    target.channel[c] =
        255 * ((samples[c].array() + share * mean) / (alpha + share).max(1e-6f)).min(1.0f);
  }
  target.weight = samples[3];
  target.weighted = true;
}

Target target_of(const SampleGrid& grid, const Layer& layer, int quad, ShadedQuantity quantity) {
  const BicubicBezier<Color> color = to_bezier(ferguson_patch(layer.patches, quad).color);
  const bool opaque = layer.patches.opaque;
  const std::array<Samples, 4> samples = sampled(grid, color, opaque);
  Target target;
  target.channels = channels_of(quantity);
  if (quantity == ShadedQuantity::alpha) {
    target.channel[0] = 255 * samples[3];
  } else if (quantity == ShadedQuantity::color && !opaque) {
    set_straight(target, samples);
  } else {
    for (int c = 0; c < 3; ++c) {
      target.channel[c] = 255 * (samples[c].array() + 1 - samples[3].array()).min(1.0f).matrix();
      if (opaque) target.channel[c] = 255 * samples[c];
    }
  }
  return target;
}

/// Mean squared error of the fit for every pair of counts, colours not clamped, unweighted: what
/// the orthogonal projection leaves of the samples.
Eigen::MatrixXf projection_errors(const SampleGrid& grid, const Target& target) {
  const auto counts = static_cast<Eigen::Index>(grid.hats.size());
  Eigen::MatrixXf error = Eigen::MatrixXf::Zero(counts, counts);
  for (int c = 0; c < target.channels; ++c) {
    const Samples centred = target.channel[c].array() - target.channel[c].mean();
    const float whole = centred.squaredNorm();
    for (Eigen::Index i = 0; i < counts; ++i) {
      const Eigen::MatrixXf along_u = grid.hats[i].orthonormal.transpose() * centred;
      for (Eigen::Index j = 0; j < counts; ++j) {
        const float kept = (along_u * grid.hats[j].orthonormal).squaredNorm();
        error(i, j) += std::max(whole - kept, 0.0f);
      }
    }
  }
  return error / float(target.channels * target.channel[0].size());
}

struct Fit {
  std::array<Eigen::MatrixXf, 3> nodes;  ///< (u, v)
  double mean_squared = 0, largest = 0;
};

Fit fitted(const Target& target, const HatBasis& u, const HatBasis& v) {
  Fit fit;
  for (int c = 0; c < target.channels; ++c) {
    const Eigen::MatrixXf nodes = u.fit * target.channel[c] * v.fit.transpose();
    fit.nodes[c] = (nodes.array() + kRounding).max(0.0f).min(255.0f).floor();
    // What rounding up may have added is no error.
    const Samples above = u.hats * fit.nodes[c] * v.hats.transpose() - target.channel[c];
    Samples error = above.cwiseAbs().cwiseMin((above.array() - kAdded).abs().matrix());
    if (target.weighted) error = error.cwiseProduct(target.weight);
    fit.mean_squared += error.squaredNorm() / double(target.channels * error.size());
    fit.largest = std::max(fit.largest, double(error.maxCoeff()));
  }
  return fit;
}

/// Greatest index into kCounts with cells that are not too short.
Divisions finest(const BicubicBezier<Eigen::Vector2d>& position) {
  const auto index = [&](int side) {
    const PlaneCurve a = side_curve(position, side), b = side_curve(position, side + 2);
    const double length = std::max((a[3] - a[0]).norm(), (b[3] - b[0]).norm());
    int most = 0;
    while (most + 1 < kCountCount && kCounts[most] * kSmallestSide < length) ++most;
    return most;
  };
  return {index(0), index(1)};
}

struct Candidate {
  int u = 0, v = 0;
  int cells() const { return kCounts[u] * kCounts[v]; }
};

/// All pairs of counts, those with few cells first.
std::vector<Candidate> candidates(const Divisions& limit) {
  std::vector<Candidate> all;
  for (int i = 0; i <= limit.u; ++i) {
    for (int j = 0; j <= limit.v; ++j) all.push_back({i, j});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cells() < b.cells(); });
  return all;
}

PatchCells cells_of(const Fit& fit, const Candidate& chosen, int channels) {
  PatchCells cells;
  cells.count = {kCounts[chosen.u], kCounts[chosen.v]};
  for (int j = 0; j <= cells.count.v; ++j) {
    for (int i = 0; i <= cells.count.u; ++i) {
      auto& node = cells.nodes.emplace_back();
      for (int c = 0; c < channels; ++c) node[c] = static_cast<std::uint8_t>(fit.nodes[c](i, j));
    }
  }
  return cells;
}

/// The cells found on this grid: without a fit when none within the limit is good enough, unless
/// `last_resort`.
std::optional<PatchCells> fit_on(const SampleGrid& grid, const Target& target,
                                 const Divisions& limit, double tolerance, bool last_resort) {
  const Eigen::MatrixXf errors = projection_errors(grid, target);
  const double bound = 0.25 * tolerance * tolerance;
  for (const Candidate& c : candidates(limit)) {
    const bool last = last_resort && c.u == limit.u && c.v == limit.v;
    if (!last && !target.weighted && errors(c.u, c.v) > bound) continue;
    const Fit fit = fitted(target, grid.hats[c.u], grid.hats[c.v]);
    if (last || (fit.mean_squared <= bound && fit.largest <= 2 * tolerance)) {
      return cells_of(fit, c, target.channels);
    }
  }
  return {};
}

}  // namespace

void CellTable::add(int quad, const PatchCells& cells) {
  counts_[quad] = {static_cast<std::uint8_t>(cells.count.u),
                   static_cast<std::uint8_t>(cells.count.v)};
  first_[quad] = nodes_.size();
  nodes_.insert(nodes_.end(), cells.nodes.begin(), cells.nodes.end());
}

PatchCells fit_cells(const Layer& layer, int quad, ShadedQuantity quantity, double tolerance) {
  const Divisions limit = finest(to_bezier(placed_geometry(layer, quad)));
  const Divisions coarse{std::min(limit.u, kCoarseCounts - 1),
                         std::min(limit.v, kCoarseCounts - 1)};
  const bool enough = coarse.u == limit.u && coarse.v == limit.v;
  const SampleGrid& grid = coarse_grid();
  const auto cells =
      fit_on(grid, target_of(grid, layer, quad, quantity), coarse, tolerance, enough);
  if (cells) return *cells;
  const SampleGrid& fine = fine_grid();
  return *fit_on(fine, target_of(fine, layer, quad, quantity), limit, tolerance, true);
}

}  // namespace quadrille
