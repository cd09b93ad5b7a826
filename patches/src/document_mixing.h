#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "document_range_coder.h"

namespace quadrille {

/// ln(p / (1 - p)) in 1/256, for p in 1/65536; and back. Integers only: every machine agrees.
int stretch(std::uint32_t probability);
std::uint32_t squash(int logit);

/// Weighs the opinions of several models about one kind of decision (logistic mixing: Mahoney,
/// "Adaptive weighing of context models for lossless data compression", 2005).
template <int kModels>
class Mixer {
 public:
  template <class Coder>
  bool code(Coder& coder, const std::array<AdaptiveBit*, kModels>& models, bool value) {
    std::array<int, kModels> logits;
    std::int64_t sum = 0;
    for (int i = 0; i < kModels; ++i) {
      logits[i] = stretch(models[i]->probability());
      sum += std::int64_t{weights_[i]} * logits[i];
    }
    const std::uint32_t probability = squash(static_cast<int>(sum / kOne));
    value = coder.decide(probability, value);
    const std::int64_t error = (value ? 65536 : 0) - static_cast<std::int64_t>(probability);
    for (int i = 0; i < kModels; ++i) {
      const std::int64_t weight = weights_[i] + error * logits[i] / kOne;
      weights_[i] = static_cast<std::int32_t>(std::clamp(weight, -kMostWeight, kMostWeight));
      models[i]->learn(value);
    }
    return value;
  }

 private:
  static constexpr std::int64_t kOne = 65536;
  static constexpr std::int64_t kMostWeight = 256 * kOne;
  std::array<std::int32_t, kModels> weights_ = [] {
    std::array<std::int32_t, kModels> weights;
    weights.fill(static_cast<std::int32_t>(kOne * 5 / 4 / kModels));
    return weights;
  }();
};

/// Integers as AdaptiveInteger codes them, every decision mixed from models of several contexts.
template <int kModels>
class MixedInteger {
 public:
  /// `contexts`: per kind of context how many there are.
  explicit MixedInteger(const std::array<int, kModels>& contexts) {
    for (int i = 0; i < kModels; ++i) models_[i].resize(contexts[i]);
  }

  /// |value| < 2^30.
  template <class Coder>
  int code(Coder& coder, const std::array<int, kModels>& contexts, int value = 0) {
    const auto decide = [&](int decision, bool wish) {
      std::array<AdaptiveBit*, kModels> models;
      for (int i = 0; i < kModels; ++i) models[i] = &models_[i][contexts[i]][decision];
      return mixers_[decision].code(coder, models, wish);
    };
    if (!decide(kNonzero, value != 0)) return 0;
    const bool negative = decide(kNegative, value < 0);
    const auto magnitude = static_cast<std::uint32_t>(value < 0 ? -value : value);
    int bits = 0;  // below the leading one
    while (decide(kLonger + bits, (magnitude >> bits) > 1)) {
      if (++bits == kMostBits) coder.refuse("a number is too large");
    }
    std::uint32_t result = 1;
    int left = bits;
    for (; left > 0 && result < 4; --left) {
      const bool bit =
          decide(kHigh + 4 * bits + static_cast<int>(result), magnitude >> (left - 1) & 1);
      result = result << 1 | (bit ? 1u : 0u);
    }
    while (left > 0) {
      const int count = left < 16 ? left : 16;
      left -= count;
      result = result << count | coder.even_bits((magnitude >> left) & ((1u << count) - 1), count);
    }
    return negative ? -static_cast<int>(result) : static_cast<int>(result);
  }

 private:
  static constexpr int kMostBits = 30;
  static constexpr int kNonzero = 0, kNegative = 1, kLonger = 2, kHigh = kLonger + kMostBits;
  static constexpr int kDecisions = kHigh + 4 * kMostBits;
  std::array<std::vector<std::array<AdaptiveBit, kDecisions>>, kModels> models_;
  std::array<Mixer<kModels>, kDecisions> mixers_;
};

}  // namespace quadrille
