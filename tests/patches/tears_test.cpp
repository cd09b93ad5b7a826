#include "quadrille/tears.h"

#include <gtest/gtest.h>

#include <cmath>

#include "quadrille/error.h"
#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

using Eigen::Array4d;
using Eigen::Vector2d;
using namespace testing;

/// Chains down the columns of vertices 2, 4 (the middle one), and 6 of a lattice of 8 columns.
struct ThreeChains {
  static constexpr int kSide = 64, kColumns = 8;
  SplitMesh split = split_mesh(kColumns, kColumns, kSide, kSide, 28.3, 35.1);
  std::vector<std::vector<int>> chains;

  ThreeChains() {
    for (const int column : {2, 4, 6}) {
      std::vector<int>& chain = chains.emplace_back();
      for (int j = 0; j < kColumns; ++j) {
        const int a = j * (kColumns + 1) + column;
        chain.push_back(edge_between(split.mesh, a, a + kColumns + 1));
      }
    }
  }
  /// Signed distance from the middle chain.
  static double side(double x, double y) { return x - (28.3 + (35.1 - 28.3) * y / kSide); }
};

using Flags = std::vector<char>;

TEST(Tears, OnlyTheChainOnTheJumpIsTorn) {
  const ThreeChains of;
  for (const double contrast : {0.02, 0.1, 0.7}) {
    const Raster picture = paint_box_filtered(64, 64, 3, 16, [&](double x, double y) -> Array4d {
      const double c = 0.2 + 0.001 * x + (of.side(x, y) > 0 ? contrast : 0);
      return {c, 0.5 + 0.1 * std::sin(y / 9), 1 - c, 1};
    });
    EXPECT_EQ(judge_tears(of.split.mesh, of.chains, picture), (Flags{0, 1, 0})) << contrast;
  }
}

TEST(Tears, ASilhouetteIsTorn) {
  const Vector2d center(31.3, 33.1);
  const DiscMesh disc = disc_mesh(4, 2, 2, 64, 64, center, 18);
  const Raster picture = paint_box_filtered(64, 64, 4, 16, [&](double x, double y) -> Array4d {
    return (Vector2d(x, y) - center).norm() < 18 ? Array4d(0.3, 0.2, 0.7, 1) : Array4d(0, 0, 0, 0);
  });
  EXPECT_EQ(judge_tears(disc.mesh, {disc.circle}, picture), Flags{1});
}

TEST(Tears, NoiseIsNotTorn) {
  const ThreeChains of;
  for (int seed = 0; seed < 5; ++seed) {
    Random random(seed);
    Raster picture(64, 64, 3);
    for (float& c : picture.data) c = static_cast<float>(random.uniform(0.4, 0.6));
    EXPECT_EQ(judge_tears(of.split.mesh, of.chains, picture), (Flags{0, 0, 0})) << seed;
  }
}

TEST(Tears, ABlurredEdgeIsNotTorn) {
  const ThreeChains of;
  const Raster picture = paint_box_filtered(64, 64, 3, 8, [&](double x, double y) -> Array4d {
    const double c = 0.2 + 0.6 / (1 + std::exp(-of.side(x, y) / 3));
    return {c, 0.5, 1 - c, 1};
  });
  EXPECT_EQ(judge_tears(of.split.mesh, of.chains, picture), (Flags{0, 0, 0}));
}

TEST(Tears, ModesAndTearsThatAreGiven) {
  ThreeChains of;
  const Raster flat(64, 64, 3);
  TearOptions options;
  options.mode = TearOptions::Mode::strong;
  EXPECT_EQ(judge_tears(of.split.mesh, of.chains, flat, {}, options), (Flags{1, 1, 1}));
  options.mode = TearOptions::Mode::off;
  EXPECT_EQ(judge_tears(of.split.mesh, of.chains, flat, {}, options), (Flags{0, 0, 0}));
  EXPECT_EQ(judge_tears(of.split.mesh, {}, flat), Flags{});
  // A border cannot be torn, and what is torn already gains nothing.
  const int border = edge_between(of.split.mesh, 0, 1);
  tear(of.split.mesh, of.chains[1]);
  const Raster picture = paint_box_filtered(64, 64, 3, 16, [&](double x, double y) -> Array4d {
    return Array4d::Constant(of.side(x, y) > 0 ? 0.8 : 0.1);
  });
  EXPECT_EQ(judge_tears(of.split.mesh, {{border}, of.chains[1]}, picture), (Flags{0, 0}));
}

TEST(Tears, AreJudgedTheSameByAnyNumberOfThreads) {
  const ThreeChains of;
  Random random(3);
  Raster picture(64, 64, 3);
  for (float& c : picture.data) c = static_cast<float>(random.uniform(0.4, 0.6));
  TearOptions options;
  options.price = 1;
  options.relative_drop = 0;
  RunContext one, two;
  one.threads = 1;
  two.threads = 2;
  EXPECT_EQ(judge_tears(of.split.mesh, of.chains, picture, {}, options, one),
            judge_tears(of.split.mesh, of.chains, picture, {}, options, two));
}

TEST(Tears, RejectsWhatItCannotJudge) {
  const ThreeChains of;
  const auto code_of = [&](const std::vector<std::vector<int>>& chains, TearOptions options) {
    try {
      judge_tears(of.split.mesh, chains, Raster(64, 64, 3), {}, options);
    } catch (const Error& e) {
      return e.code();
    }
    return ErrorCode::numerical_failure;
  };
  EXPECT_EQ(code_of({{-1}}, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of({{0, of.split.mesh.edge_count()}}, {}), ErrorCode::invalid_argument);
  TearOptions options;
  options.price = std::nan("");
  EXPECT_EQ(code_of(of.chains, options), ErrorCode::invalid_argument);
  options = {};
  options.relative_drop = 2;
  EXPECT_EQ(code_of(of.chains, options), ErrorCode::invalid_argument);
}

}  // namespace
}  // namespace quadrille
