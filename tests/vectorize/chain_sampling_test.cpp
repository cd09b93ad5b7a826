#include "chain_sampling.h"

#include <gtest/gtest.h>

#include <vector>

namespace quadrille {
namespace {

using Eigen::Vector2d;

/// A straight chain from (20, 30) to (60, 30).
ChainNetwork straight_chain() {
  ChainNetwork network;
  network.nodes = {{20, 30}, {60, 30}};
  FeatureChain chain{.from = 0, .to = 1, .length = 40};
  for (int x = 20; x <= 60; ++x) chain.points.emplace_back(x, 30);
  network.chains.push_back(chain);
  return network;
}

/// The samples that take the place of lattice points about 10 pixels apart.
ChainSamples sampled(const std::vector<Vector2d>& lattice_points) {
  LatticeGraph graph;
  graph.points = lattice_points;
  graph.spacing.assign(lattice_points.size(), 10);
  const auto spacing = [](const Vector2d&, const Vector2d&) { return 10.0; };
  return sample_chains(straight_chain(), graph, spacing, 100, 100);
}

void expect_pieces_have_lengths(const ChainSamples& samples) {
  for (const ChainSamples::Piece& piece : samples.pieces) {
    EXPECT_LT(piece.from, piece.to);
    EXPECT_NE(piece.a, piece.b);
  }
}

TEST(ChainSampling, LatticePointsNearAChainBecomeItsSamples) {
  const ChainSamples samples = sampled({{31, 31}, {41, 29}, {51, 30}, {31, 60}});
  expect_pieces_have_lengths(samples);
  ASSERT_EQ(samples.pieces.size(), 4u);
  EXPECT_DOUBLE_EQ(samples.pieces[0].to, 11);
  EXPECT_DOUBLE_EQ(samples.pieces[1].to, 21);
  EXPECT_DOUBLE_EQ(samples.pieces[2].to, 31);
  EXPECT_EQ(samples.sample_of_lattice_point[3], kNoSample);
}

TEST(ChainSampling, PointsAtTheSamePlaceShareASample) {
  // Two lattice points beside the same place, and one beside either end.
  const ChainSamples samples = sampled({{40, 31}, {40, 29}, {20, 31}, {60, 29}});
  expect_pieces_have_lengths(samples);
  const std::vector<int>& sample = samples.sample_of_lattice_point;
  EXPECT_EQ(sample[0], sample[1]);
  EXPECT_EQ(sample[2], 0);
  EXPECT_EQ(sample[3], 1);
}

}  // namespace
}  // namespace quadrille
