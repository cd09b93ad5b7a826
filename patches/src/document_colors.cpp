#include "document_colors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <bit>
#include <cmath>

#include "document_mixing.h"
#include "document_prediction.h"

namespace quadrille {
namespace {

/// Weighted sums whose weights are multiples of 1 / 64.
template <int n>
using Terms = std::array<double, n>;
template <int n>
using Weights = std::array<int, n>;
constexpr double kWeightUnit = 64;
constexpr int kLargestWeight = 255;
constexpr int kLargestNumber = 1 << 25;

template <int n>
double weighted(const Terms<n>& terms, const Weights<n>& weights) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += terms[i] * weights[i] / kWeightUnit;
  return sum;
}

/// Least squares weights of terms, from their normal equations.
template <int n>
class WeightFit {
 public:
  void add(const Terms<n>& terms, double target, double importance) {
    const Eigen::Map<const Eigen::Matrix<double, n, 1>> t(terms.data());
    normal_ += importance * t * t.transpose();
    right_ += importance * target * t;
  }
  Weights<n> weights() const {
    Eigen::Matrix<double, n, n> normal = normal_;
    normal.diagonal().array() += 1e-9 + 1e-6 * normal_.trace();
    const Eigen::Matrix<double, n, 1> w = normal.ldlt().solve(right_);
    Weights<n> rounded_weights{};
    for (int i = 0; i < n; ++i) {
      const double x = w[i] * kWeightUnit;
      if (std::isfinite(x)) {
        rounded_weights[i] = static_cast<int>(
            std::floor(std::clamp<double>(x, -kLargestWeight, kLargestWeight) + 0.5));
      }
    }
    return rounded_weights;
  }

 private:
  Eigen::Matrix<double, n, n> normal_ = Eigen::Matrix<double, n, n>::Zero();
  Eigen::Matrix<double, n, 1> right_ = Eigen::Matrix<double, n, 1>::Zero();
};

int rounded(double x) {
  return static_cast<int>(std::floor(std::clamp<double>(x, -kLargestNumber, kLargestNumber) + 0.5));
}

/// Eighths in classes of a quarter of an octave.
int size_class(double magnitude, int classes) {
  const auto m = static_cast<unsigned>(std::clamp<double>(magnitude * 8, 0, 1 << 28));
  const int octave = std::bit_width(m);
  const int c =
      octave < 3 ? static_cast<int>(m) : 4 * octave - 8 + static_cast<int>(m >> (octave - 3) & 3);
  return std::min(c, classes - 1);
}

template <class Coder>
class ColorCoder {
 public:
  ColorCoder(Coder& coder, const PatchMesh& patches, const std::vector<ColorFrame>& frames,
             const ColorSteps& steps, std::vector<WedgeCode>& codes)
      : coder_(coder),
        steps_(steps),
        codes_(codes),
        mesh_(patches),
        corners_(patches),
        predictor_(patches, frames) {
    for (auto& channel : errors_) channel.assign(codes.size(), {});
  }

  void code(int channels) {
    for (int c = 0; c < channels; ++c) {
      predictor_.clear();
      for (const WedgeKind kind : {kValue, kAlongX, kTwist}) code_kind(c, kind);
    }
  }

 private:
  /// One channel's prediction, plus shares of the errors of the channels before.
  static constexpr int kTerms = Prediction::kTerms + 2;
  static constexpr int kSizes = 8;
  static constexpr int kClasses = 48;
  using Models = MixedInteger<3>;
  struct Guess {
    double base = 0;
    Terms<kTerms> terms{};
    double with(const Weights<kTerms>& weights) const {
      return base + weighted<kTerms>(terms, weights);
    }
  };

  Coder& coder_;
  const ColorSteps& steps_;
  std::vector<WedgeCode>& codes_;
  const PatchMesh& mesh_;
  WedgeCorners corners_;
  ChannelPredictor predictor_;
  std::array<std::vector<std::array<int, 4>>, kChannels> errors_;  // [channel][wedge][kind]
  AdaptiveInteger weight_;

  double number(int w, int c, WedgeKind kind) const {
    return codes_[w][c][kind] * steps_(w, c, kind);
  }

  /// A kind that both axes share comes as kAlongX.
  void code_kind(int c, WedgeKind first) {
    const bool both = first == kAlongX;
    const int count = static_cast<int>(codes_.size());
    Weights<kTerms> weights{};
    Weights<kSizes> size_weights{};
    std::vector<Guess> guesses;  // of the encoder, which knows everything from the start
    if constexpr (!Coder::kDecodes) {
      for (int w = 0; w < count; ++w) {
        for (int kind = first; kind <= first + both; ++kind) {
          guesses.push_back(guess(w, c, static_cast<WedgeKind>(kind)));
        }
        learn(w, c, first, both);
      }
      weights = best_weights(c, first, both, guesses);
      size_weights = best_size_weights(c, first, both);
    }
    for (int& weight : weights) weight = weight_.code(coder_, weight);
    for (int& weight : size_weights) weight = weight_.code(coder_, weight);
    Models models({kClasses, kClasses, kClasses});
    std::size_t next = 0;
    for (int w = 0; w < count; ++w) {
      for (int kind = first; kind <= first + both; ++kind) {
        const auto k = static_cast<WedgeKind>(kind);
        const Guess g = Coder::kDecodes ? guess(w, c, k) : guesses[next++];
        code_number(w, c, k, g.with(weights), size_weights, models);
      }
      if constexpr (Coder::kDecodes) learn(w, c, first, both);
    }
  }

  /// Nearly those of least absolute error, by iterated weights. Leaves the errors in errors_.
  Weights<kTerms> best_weights(int c, WedgeKind first, bool both,
                               const std::vector<Guess>& guesses) {
    Weights<kTerms> weights{};
    const int count = static_cast<int>(codes_.size());
    for (int round = 0; round < 3; ++round) {
      WeightFit<kTerms> fit;
      std::size_t next = 0;
      for (int w = 0; w < count; ++w) {
        for (int kind = first; kind <= first + both; ++kind) {
          const auto k = static_cast<WedgeKind>(kind);
          const Guess& g = guesses[next++];
          const double step = steps_(w, c, k), target = number(w, c, k) - g.base;
          const double error =
              round == 0 ? 0 : std::abs(target - weighted<kTerms>(g.terms, weights));
          fit.add(g.terms, target, 1 / (step * (step + error)));
        }
      }
      weights = fit.weights();
    }
    std::size_t next = 0;
    for (int w = 0; w < count; ++w) {
      for (int kind = first; kind <= first + both; ++kind) {
        const auto k = static_cast<WedgeKind>(kind);
        errors_[c][w][k] =
            codes_[w][c][k] - rounded(guesses[next++].with(weights) / steps_(w, c, k));
      }
    }
    return weights;
  }

  Weights<kSizes> best_size_weights(int c, WedgeKind first, bool both) const {
    Weights<kSizes> weights{};
    for (int round = 0; round < 3; ++round) {
      WeightFit<kSizes> fit;
      for (int w = 0; w < static_cast<int>(codes_.size()); ++w) {
        for (int kind = first; kind <= first + both; ++kind) {
          const auto k = static_cast<WedgeKind>(kind);
          const Terms<kSizes> terms = sizes_nearby(w, c, k);
          const double size = round == 0 ? terms[0] : weighted<kSizes>(terms, weights);
          fit.add(terms, std::abs(errors_[c][w][k]), 1 / (1 + size * size));
        }
      }
      weights = fit.weights();
    }
    return weights;
  }

  void learn(int w, int c, WedgeKind first, bool both) {
    predictor_.learn(w, first, number(w, c, first));
    if (both) predictor_.learn(w, kAlongY, number(w, c, kAlongY));
  }

  Guess guess(int w, int c, WedgeKind kind) const {
    const Prediction p = predictor_.predict(w, kind);
    Guess g{p.base, {}};
    std::copy(p.terms.begin(), p.terms.end(), g.terms.begin());
    for (int before = 0; before < std::min(c, 2); ++before) {
      g.terms[Prediction::kTerms + before] = errors_[before][w][kind] * steps_(w, before, kind);
    }
    return g;
  }

  void code_number(int w, int c, WedgeKind kind, double guess, const Weights<kSizes>& size_weights,
                   Models& models) {
    const int expected = rounded(guess / steps_(w, c, kind));
    int& number = codes_[w][c][kind];
    const Terms<kSizes> sizes = sizes_nearby(w, c, kind);
    const std::array<int, 3> contexts = {
        size_class(weighted<kSizes>(sizes, size_weights), kClasses),
        size_class(sizes[0] + sizes[1], kClasses),
        size_class(sizes[2] + sizes[3] + sizes[4] + sizes[5], kClasses)};
    number = expected + models.code(coder_, contexts, number - expected);
    if (std::abs(number) > kLargestNumber) coder_.refuse("a colour is out of range");
    errors_[c][w][kind] = number - expected;
  }

  /// Magnitudes, in steps, of errors that tell how large the next one is likely to be.
  Terms<kSizes> sizes_nearby(int w, int c, WedgeKind kind) const {
    const auto& errors = errors_[c];
    Terms<kSizes> sizes{};
    int side_count = 0, across_count = 0;
    const auto add = [&](int g, double& sum, int& count) {
      const int other = mesh_.wedge_of_corner[g];
      if (other >= w) return;
      sum += std::abs(errors[other][kind]) * steps_(other, c, kind);
      ++count;
    };
    for (const int h : corners_[w]) {
      add(QuadMesh::next(h), sizes[0], side_count);
      add(QuadMesh::prev(h), sizes[0], side_count);
      add(QuadMesh::next(QuadMesh::next(h)), sizes[1], across_count);
    }
    const double step = steps_(w, c, kind);
    sizes[0] /= std::max(side_count, 1) * step;
    sizes[1] /= std::max(across_count, 1) * step;
    for (int before = 0; before < std::min(c, 2); ++before) {
      sizes[2 + before] = std::abs(errors_[before][w][kind]);
    }
    if (kind != kValue) sizes[4] = std::abs(errors[w][kValue]);
    if (kind == kAlongY) sizes[5] = std::abs(errors[w][kAlongX]);
    if (kind == kTwist) sizes[5] = std::abs(errors[w][kAlongX]) + std::abs(errors[w][kAlongY]);
    sizes[6] = 1;
    sizes[7] = 1 / steps_.scale(w);
    return sizes;
  }
};

template <class Coder>
void code_colors(Coder& coder, QuantizedPatches& patches, const PositionGrid& grid,
                 double color_step) {
  const PatchMesh known = geometry_of(patches);
  const std::vector<ColorFrame> frames = color_frames(known.mesh, grid.step());
  const ColorSteps steps(known.mesh, known.wedge_of_corner, known.wedges.size(), color_step);
  ColorCoder<Coder>(coder, known, frames, steps, patches.wedges)
      .code(patches.opaque ? 3 : kChannels);
}

}  // namespace

void encode_colors(RangeEncoder& coder, const QuantizedPatches& patches, const PositionGrid& grid,
                   double color_step) {
  QuantizedPatches copy = patches;
  code_colors(coder, copy, grid, color_step);
}

void decode_colors(RangeDecoder& coder, QuantizedPatches& patches, const PositionGrid& grid,
                   double color_step) {
  code_colors(coder, patches, grid, color_step);
}

}  // namespace quadrille
