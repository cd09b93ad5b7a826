#include "document_colors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <bit>
#include <cmath>

#include "document_prediction.h"

namespace quadrille {
namespace {

/// One channel's prediction, plus shares of the errors of the channels before.
constexpr int kTerms = Prediction::kTerms + 2;
using Terms = std::array<double, kTerms>;
using Weights = std::array<int, kTerms>;  ///< in 1 / kWeightUnit
constexpr double kWeightUnit = 64;
constexpr int kLargestWeight = 255;
constexpr int kLargestNumber = 1 << 25;

int rounded(double x) {
  return static_cast<int>(std::floor(std::clamp<double>(x, -kLargestNumber, kLargestNumber) + 0.5));
}

/// Magnitudes in classes of half an octave.
int size_class(int magnitude, int classes) {
  const auto m = static_cast<unsigned>(magnitude);
  const int octave = std::bit_width(m);
  const int c = octave < 2 ? octave : 2 * octave - 2 + static_cast<int>(m >> (octave - 2) & 1);
  return std::min(c, classes - 1);
}

struct Guess {
  double base = 0;
  Terms terms{};

  double with(const Weights& weights) const {
    double guess = base;
    for (int i = 0; i < kTerms; ++i) guess += terms[i] * weights[i] / kWeightUnit;
    return guess;
  }
};

/// Least squares weights of terms, from their normal equations.
class WeightFit {
 public:
  void add(const Terms& terms, double target) {
    const Eigen::Map<const Eigen::Matrix<double, kTerms, 1>> t(terms.data());
    normal_ += t * t.transpose();
    right_ += t * target;
  }
  Weights weights() const {
    Eigen::Matrix<double, kTerms, kTerms> n = normal_;
    n.diagonal().array() += 1e-9 + 1e-6 * normal_.trace();
    const Eigen::Matrix<double, kTerms, 1> w = n.ldlt().solve(right_);
    Weights rounded_weights{};
    for (int i = 0; i < kTerms; ++i) {
      const double x = w[i] * kWeightUnit;
      if (std::isfinite(x)) {
        rounded_weights[i] = static_cast<int>(
            std::floor(std::clamp<double>(x, -kLargestWeight, kLargestWeight) + 0.5));
      }
    }
    return rounded_weights;
  }

 private:
  Eigen::Matrix<double, kTerms, kTerms> normal_ = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Eigen::Matrix<double, kTerms, 1> right_ = Eigen::Matrix<double, kTerms, 1>::Zero();
};

template <class Coder>
class ColorCoder {
 public:
  ColorCoder(Coder& coder, const PatchMesh& patches, const std::vector<ColorFrame>& frames,
             double color_step, std::vector<WedgeCode>& codes)
      : coder_(coder),
        color_step_(color_step),
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
  static constexpr int kClasses = 18;
  struct Models {
    AdaptiveInteger of_class[kClasses];
  };

  Coder& coder_;
  double color_step_;
  std::vector<WedgeCode>& codes_;
  const PatchMesh& mesh_;
  WedgeCorners corners_;
  ChannelPredictor predictor_;
  std::array<std::vector<std::array<int, 4>>, kChannels> errors_;  // [channel][wedge][kind]
  AdaptiveInteger weight_;

  double number(int w, int c, WedgeKind kind) const {
    return codes_[w][c][kind] * color_step_of(c, kind, color_step_);
  }

  /// A kind that both axes share comes as kAlongX.
  void code_kind(int c, WedgeKind first) {
    const bool both = first == kAlongX;
    const int count = static_cast<int>(codes_.size());
    Weights weights{};
    std::vector<Guess> guesses;  // of the encoder, which knows everything from the start
    if constexpr (!Coder::kDecodes) {
      WeightFit fit;
      for (int w = 0; w < count; ++w) {
        for (int kind = first; kind <= first + both; ++kind) {
          const auto k = static_cast<WedgeKind>(kind);
          guesses.push_back(guess(w, c, k));
          fit.add(guesses.back().terms, number(w, c, k) - guesses.back().base);
        }
        learn(w, c, first, both);
      }
      weights = fit.weights();
    }
    for (int& weight : weights) weight = weight_.code(coder_, weight);
    Models models[2];
    std::size_t next = 0;
    for (int w = 0; w < count; ++w) {
      for (int kind = first; kind <= first + both; ++kind) {
        const auto k = static_cast<WedgeKind>(kind);
        const Guess g = Coder::kDecodes ? guess(w, c, k) : guesses[next++];
        code_number(w, c, k, g.with(weights), models[kind - first]);
      }
      if constexpr (Coder::kDecodes) learn(w, c, first, both);
    }
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
      g.terms[Prediction::kTerms + before] =
          errors_[before][w][kind] * color_step_of(before, kind, color_step_);
    }
    return g;
  }

  void code_number(int w, int c, WedgeKind kind, double guess, Models& models) {
    const int expected = rounded(guess / color_step_of(c, kind, color_step_));
    int& number = codes_[w][c][kind];
    AdaptiveInteger& model = models.of_class[size_class(activity(w, c, kind), kClasses)];
    number = expected + model.code(coder_, number - expected);
    if (std::abs(number) > kLargestNumber) coder_.refuse("a colour is out of range");
    errors_[c][w][kind] = number - expected;
  }

  /// How large the error is likely to be.
  int activity(int w, int c, WedgeKind kind) const {
    const auto& errors = errors_[c];
    long long near = 0, count = 0;
    for (const int h : corners_[w]) {
      for (const int g :
           {QuadMesh::next(h), QuadMesh::prev(h), QuadMesh::next(QuadMesh::next(h))}) {
        const int other = mesh_.wedge_of_corner[g];
        if (other >= w) continue;
        near += std::abs(errors[other][kind]);
        ++count;
      }
    }
    long long sum = count > 0 ? 4 * near / count : 4 * std::abs(errors[w][kind]);
    if (c > 0 && c < 3) sum += std::abs(errors_[0][w][kind]);
    if (kind != kValue) sum += std::abs(errors[w][kValue]);
    return static_cast<int>(std::min<long long>(sum, 1 << 28));
  }
};

template <class Coder>
void code_colors(Coder& coder, QuantizedPatches& patches, const PositionGrid& grid,
                 double color_step) {
  const PatchMesh known = geometry_of(patches);
  const std::vector<ColorFrame> frames = color_frames(known.mesh, grid.step());
  ColorCoder<Coder>(coder, known, frames, color_step, patches.wedges)
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
