// What is left out of a network of chains: pieces too near to stronger ones, and the weakest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "chain_separation.h"
#include "quadrille/feature_chains.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kDistance = 1, kMinLength = 6;

/// Adds a chain along y(x) for x from `begin` to `end`, with a node at each end that is not given.
template <class Height>
void add_chain(ChainNetwork& network, double begin, double end, double contrast,
               const Height& height, int from = -1, int to = -1) {
  FeatureChain chain;
  for (double x = begin; x <= end; x += 0.5) chain.points.emplace_back(x, height(x));
  for (std::size_t i = 1; i < chain.points.size(); ++i) {
    chain.length += (chain.points[i] - chain.points[i - 1]).norm();
  }
  const auto node = [&](int given, const Vector2d& p) {
    if (given >= 0) return given;
    network.nodes.push_back(p);
    return static_cast<int>(network.nodes.size()) - 1;
  };
  chain.from = node(from, chain.points.front());
  chain.to = node(to, chain.points.back());
  chain.contrast = chain.gain = contrast;
  network.chains.push_back(std::move(chain));
}

double level(double) { return 20; }

TEST(SeparateChains, ThoseApartStay) {
  ChainNetwork network;
  add_chain(network, 0, 40, 0.5, level);
  add_chain(network, 0, 40, 0.9, [](double) { return 21.5; });
  separate_chains(network, kDistance, kMinLength);
  ASSERT_EQ(network.chains.size(), 2u);
  for (const FeatureChain& chain : network.chains) EXPECT_NEAR(chain.length, 40, 1e-9);
}

TEST(SeparateChains, TheWeakerOneIsCutWhereItComesNear) {
  ChainNetwork network;
  add_chain(network, 0, 60, 0.3, [](double x) { return 20 + std::pow((x - 30) / 10, 2); });
  add_chain(network, 0, 60, 0.8, level);
  separate_chains(network, kDistance, kMinLength);
  ASSERT_EQ(network.chains.size(), 3u);
  for (const FeatureChain& chain : network.chains) {
    EXPECT_EQ(network.nodes.at(chain.from), chain.points.front());
    EXPECT_EQ(network.nodes.at(chain.to), chain.points.back());
    if (chain.contrast == 0.8) {
      EXPECT_NEAR(chain.length, 60, 1e-9);
      continue;
    }
    // The parabola is one pixel away from the line 10 pixels from its vertex.
    EXPECT_NEAR(chain.points.back().x() - chain.points.front().x(), 20, 1);
    for (const Vector2d& p : chain.points) EXPECT_GE(p.y() - 20, kDistance - 1e-9);
  }
}

TEST(SeparateChains, ShortLeftoversGo) {
  ChainNetwork network;
  add_chain(network, 0, 40, 0.8, level);
  add_chain(network, 0, 40, 0.3, [](double x) { return x < 3.8 ? 23 : 20.5; });
  separate_chains(network, kDistance, kMinLength);
  ASSERT_EQ(network.chains.size(), 1u);
  EXPECT_EQ(network.chains[0].contrast, 0.8);
}

TEST(SeparateChains, ThoseFromOneNodeMayBeNearThere) {
  ChainNetwork network;
  add_chain(network, 0, 40, 0.8, level);
  add_chain(
      network, 0, 40, 0.3, [](double x) { return 20 + 0.5 * x; }, 0);
  separate_chains(network, kDistance, kMinLength);
  ASSERT_EQ(network.chains.size(), 2u);
  EXPECT_EQ(network.chains[0].from, network.chains[1].from);
  EXPECT_EQ(network.chains[1].points.size(), 81u);
}

TEST(ShedWeakChains, LeavesOutTheLeastGainsUntilTheVerticesSuffice) {
  ChainNetwork network;
  for (const double gain : {3, 1, 5, 2}) add_chain(network, 0, 10, gain, level);
  // A chain of 10 pixels needs 10 / 5 and one more.
  ChainNetwork all = network;
  shed_weak_chains(all, 5, 12);
  EXPECT_EQ(all.chains.size(), 4u);
  shed_weak_chains(network, 5, 8);
  ASSERT_EQ(network.chains.size(), 2u);
  EXPECT_EQ(network.chains[0].gain, 5);
  EXPECT_EQ(network.chains[1].gain, 3);
  EXPECT_EQ(network.nodes.size(), 4u);
  for (const FeatureChain& chain : network.chains) {
    EXPECT_EQ(network.nodes.at(chain.from), chain.points.front());
    EXPECT_EQ(network.nodes.at(chain.to), chain.points.back());
  }
  shed_weak_chains(network, 5, 0);
  EXPECT_TRUE(network.chains.empty());
  EXPECT_TRUE(network.nodes.empty());
}

}  // namespace
}  // namespace quadrille
