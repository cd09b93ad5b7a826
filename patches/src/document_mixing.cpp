#include "document_mixing.h"

#include <algorithm>

namespace quadrille {
namespace {

constexpr int kStep = 128, kMiddle = 24;  // of the table, in units of stretch()
/// 65536 / (1 + exp(-x)) for x = -12, -11.5, ..., 12.
constexpr std::array<std::int32_t, 2 * kMiddle + 1> kLogistic = {
    0,     1,     1,     2,     3,     5,     8,     13,    22,    36,    60,    98,    162,
    267,   439,   720,   1179,  1921,  3108,  4971,  7812,  11955, 17625, 24743, 32768, 40793,
    47911, 53581, 57724, 60565, 62428, 63615, 64357, 64816, 65097, 65269, 65374, 65438, 65476,
    65500, 65514, 65523, 65528, 65531, 65533, 65534, 65535, 65535, 65536};
constexpr int kMostLogit = kStep * kMiddle - 1;

constexpr std::int32_t logistic(int logit) {
  const int at = logit + kStep * kMiddle, i = at / kStep, part = at % kStep;
  return (kLogistic[i] * (kStep - part) + kLogistic[i + 1] * part) / kStep;
}

/// For probabilities in 1/4096: the least logit with at least that probability.
const std::array<std::int16_t, 4097> kLogits = [] {
  std::array<std::int16_t, 4097> logits{};
  int logit = -kMostLogit;
  for (int p = 0; p <= 4096; ++p) {
    while (logit < kMostLogit && logistic(logit) < 16 * p) ++logit;
    logits[p] = static_cast<std::int16_t>(logit);
  }
  return logits;
}();

}  // namespace

int stretch(std::uint32_t probability) {
  const auto i = static_cast<int>(probability >> 4), part = static_cast<int>(probability & 15);
  return (kLogits[i] * (16 - part) + kLogits[i + 1] * part) / 16;
}

std::uint32_t squash(int logit) {
  constexpr std::int32_t kLeast = 32;
  const std::int32_t p = logistic(std::clamp(logit, -kMostLogit, kMostLogit));
  return static_cast<std::uint32_t>(std::clamp(p, kLeast, 65536 - kLeast));
}

}  // namespace quadrille
