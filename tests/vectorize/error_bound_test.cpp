#include "quadrille/error_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "error_search.h"
#include "quadrille/error.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"

namespace quadrille {
namespace {

struct Found {
  int quads = 0;  ///< the smallest number tried that meets the bound; 0 for none
  int rounds = 0;
};

template <class ErrorOf>
Found search(double bound, int first, int max_quads, const ErrorOf& error_of) {
  ErrorSearch search(bound, max_quads);
  Found found;
  for (std::optional<int> quads = first; quads && found.rounds < 50; quads = search.next()) {
    const double error = error_of(*quads);
    search.observe(*quads, error);
    ++found.rounds;
    if (error <= bound && (found.quads == 0 || *quads < found.quads)) found.quads = *quads;
  }
  return found;
}

TEST(ErrorSearch, APowerLawTakesFewRounds) {
  for (const double exponent : {0.3, 0.5, 1.0}) {
    for (const double bound : {1.0, 3.0, 10.0}) {
      const auto error_of = [=](int quads) { return 200 * std::pow(quads, -exponent); };
      const double exact = std::pow(200 / bound, 1 / exponent);
      if (exact > 1e6) continue;
      const Found found = search(bound, 3000, 2'000'000, error_of);
      EXPECT_GE(found.quads, exact) << exponent << " " << bound;
      EXPECT_LE(found.quads, std::ceil(exact * std::pow(0.95, -1 / exponent)))
          << exponent << " " << bound;
      EXPECT_LE(found.rounds, 6) << exponent << " " << bound;
    }
  }
}

TEST(ErrorSearch, JitterAndAFloorDoNotKeepItGoing) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const double floor = 0.01 * static_cast<double>(random() % 300);
    const auto error_of = [&](int quads) {
      const double jitter = 1 + 0.02 * static_cast<double>(random() % 10);
      return (floor + 150 / std::sqrt(quads)) * jitter;
    };
    const Found found = search(3, 1 + static_cast<int>(random() % 20'000), 200'000, error_of);
    EXPECT_LE(found.rounds, 12);
  }
}

TEST(ErrorSearch, EndsAtTheLimits) {
  EXPECT_EQ(search(1, 100, 5000, [](int) { return 9.0; }).quads, 0);
  EXPECT_EQ(search(1, 3000, 5000, [](int) { return 0.0; }).quads, 1);
}

/// A disc with a soft rim on a slope.
Raster picture() {
  Raster result(160, 120, 3);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      const float disc = 1 / (1 + std::exp(std::hypot(x - 80.0f, y - 60.0f) - 35));
      float* const p = result.pixel(x, y);
      p[0] = 0.2f + 0.6f * disc;
      p[1] = static_cast<float>(x) / 200;
      p[2] = 0.5f + 0.2f * std::sin(0.2f * static_cast<float>(y));
    }
  }
  return result;
}

TEST(ErrorBound, IsMetByTheRenderedPicture) {
  const BoundedVectorization bounded =
      vectorize_to_error(picture(), {.mae = 2, .max_rounds = 20}, {.quads = 60});
  ASSERT_TRUE(bounded.met);
  EXPECT_LE(bounded.mae, 2);
  EXPECT_EQ(compare(picture(), render(bounded.result.image)).mae, bounded.mae);
  EXPECT_LE(bounded.rounds.size(), 10);
  for (const ErrorBoundRound& round : bounded.rounds) {
    EXPECT_TRUE(round.mae > 2 || round.quads >= bounded.result.report.quads);
  }
}

TEST(ErrorBound, OutOfReachGivesTheBestWithinTheCeiling) {
  const BoundedVectorization bounded =
      vectorize_to_error(picture(), {.mae = 1e-6, .max_quads = 200}, {.quads = 60});
  EXPECT_FALSE(bounded.met);
  EXPECT_EQ(bounded.rounds.back().wished_quads, 200);
  for (const ErrorBoundRound& round : bounded.rounds) EXPECT_GE(round.mae, bounded.mae);
}

TEST(ErrorBound, EndsAfterTheRoundsAllowed) {
  const BoundedVectorization bounded =
      vectorize_to_error(picture(), {.mae = 0.01, .max_rounds = 2}, {.quads = 60, .lattice = true});
  EXPECT_FALSE(bounded.met);
  EXPECT_EQ(bounded.rounds.size(), 2);
}

TEST(ErrorBound, AConstantPictureTakesOneQuad) {
  const BoundedVectorization bounded =
      vectorize_to_error(Raster(40, 30, 3), {.mae = 1}, {.quads = 500, .lattice = true});
  EXPECT_TRUE(bounded.met);
  EXPECT_EQ(bounded.result.report.quads, 1);
}

TEST(ErrorBound, RefusesBoundsOutOfRange) {
  for (const ErrorBound& bound :
       {ErrorBound{.mae = 0}, ErrorBound{.mae = 256}, ErrorBound{.mae = std::nan("")},
        ErrorBound{.max_quads = -1}, ErrorBound{.max_rounds = 0}}) {
    EXPECT_THROW(vectorize_to_error(picture(), bound), Error);
  }
}

}  // namespace
}  // namespace quadrille
