#include "quadrille/feature_chains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "alpha_pictures.h"
#include "box_filtered.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using test::box_filtered, test::disc_picture, test::kBright, test::kDark;

const double kJump = (kBright - kDark).norm();

void expect_consistent(const ChainNetwork& network) {
  for (const FeatureChain& chain : network.chains) {
    ASSERT_GE(chain.points.size(), 2u);
    EXPECT_EQ(chain.points.front(), network.nodes.at(chain.from));
    EXPECT_EQ(chain.points.back(), network.nodes.at(chain.to));
    double length = 0;
    for (std::size_t i = 1; i < chain.points.size(); ++i) {
      length += (chain.points[i] - chain.points[i - 1]).norm();
    }
    EXPECT_NEAR(chain.length, length, 1e-9);
  }
}

void expect_one_loop(const ChainNetwork& network, const Vector2d& centre, double radius) {
  expect_consistent(network);
  ASSERT_EQ(network.chains.size(), 1u);
  const FeatureChain& chain = network.chains[0];
  EXPECT_EQ(chain.from, chain.to);
  for (const Vector2d& p : chain.points) {
    EXPECT_NEAR((p - centre).norm(), radius, 0.1) << p.transpose();
  }
  EXPECT_NEAR(chain.length, 2 * std::numbers::pi * radius, 0.02 * chain.length);
}

TEST(FeatureChains, ADiscHasOneClosedChain) {
  for (const auto& [centre, radius] :
       {std::pair{Vector2d(32.3, 31.6), 20.0}, {Vector2d(30, 33.5), 9.3}}) {
    const ChainNetwork network = feature_chains(disc_picture(64, 64, centre, radius));
    expect_one_loop(network, centre, radius);
    EXPECT_NEAR(network.chains.at(0).contrast, kJump, 0.03 * kJump);
    EXPECT_GT(network.chains.at(0).sharpness, 0.9);
  }
}

TEST(FeatureChains, FollowBothSidesOfAThinStroke) {
  const Vector2d centre(50.3, 49.6);
  for (const double width : {2.6, 3.0, 4.0}) {
    const double inner = 40 - width / 2, outer = 40 + width / 2;
    const Raster picture = box_filtered(100, 100, kDark, kBright, [&](double x, double y) {
      const double radius = (Vector2d(x, y) - centre).norm();
      return radius > inner && radius < outer ? 0 : 1;
    });
    const ChainNetwork network = feature_chains(picture);
    expect_consistent(network);
    double length = 0;  // of what lies on the two circles
    for (const FeatureChain& chain : network.chains) {
      for (std::size_t i = 1; i < chain.points.size(); ++i) {
        const double radius = (chain.points[i] - centre).norm();
        const double away = std::min(std::abs(radius - inner), std::abs(radius - outer));
        if (away < 0.3) length += (chain.points[i] - chain.points[i - 1]).norm();
      }
    }
    EXPECT_GT(length, 0.9 * 2 * std::numbers::pi * (inner + outer)) << width;
    EXPECT_LE(network.chains.size(), 8) << width;
  }
}

TEST(FeatureChains, ASilhouetteIsAChain) {
  const Vector2d centre(31.7, 32.2);
  const Raster picture = testing::masked_picture(64, 64, testing::disc(31.7, 32.2, 18));
  expect_one_loop(feature_chains(picture), centre, 18);
}

TEST(FeatureChains, ARectangleHasFourCorners) {
  for (const double degrees : {0.0, 13.0, 30.0, 45.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vector2d centre(40.3, 39.6), u(std::cos(angle), std::sin(angle)), v(-u.y(), u.x());
    const Raster picture = box_filtered(80, 80, kDark, kBright, [&](double x, double y) {
      const Vector2d d = Vector2d(x, y) - centre;
      return std::abs(d.dot(u)) < 24 && std::abs(d.dot(v)) < 15 ? 1 : 0;
    });
    const ChainNetwork network = feature_chains(picture);
    expect_consistent(network);
    for (const auto& [i, j] : {std::array{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const Vector2d corner = centre + 24 * i * u + 15 * j * v;
      double nearest = 1e9;
      for (const Vector2d& node : network.nodes) {
        nearest = std::min(nearest, (node - corner).norm());
      }
      EXPECT_LT(nearest, 0.3) << degrees << " degrees, corner " << corner.transpose();
    }
    double length = 0;
    for (const FeatureChain& chain : network.chains) {
      length += chain.length;
      for (const Vector2d& p : chain.points) {
        const Vector2d d = p - centre;
        const double off =
            std::max(std::abs(d.dot(u)) - 24, std::abs(d.dot(v)) - 15);  // inside negative
        EXPECT_NEAR(off, 0, 0.25) << degrees << " degrees, " << p.transpose();
      }
    }
    EXPECT_NEAR(length, 4 * (24 + 15), 3) << degrees << " degrees";
  }
}

TEST(FeatureChains, ThreeSectorsMeetAtAJunction) {
  const Vector2d centre(32.4, 31.7);
  Raster picture(64, 64, 3);
  for (int sector = 0; sector < 3; ++sector) {
    const Raster share = box_filtered(
        64, 64, Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), [&](double x, double y) {
          const double angle = std::atan2(y - centre.y(), x - centre.x()) + 0.3;
          const double turn = angle / (2 * std::numbers::pi);
          return static_cast<int>(3 * (turn - std::floor(turn))) == sector ? 1 : 0;
        });
    for (std::size_t i = 0; i < share.data.size(); ++i) {
      picture.data[i] += (static_cast<int>(i % 3) == sector ? 0.9f : 0.1f) * share.data[i];
    }
  }
  const ChainNetwork network = feature_chains(picture);
  expect_consistent(network);
  ASSERT_EQ(network.chains.size(), 3u);
  ASSERT_EQ(network.nodes.size(), 4u);
  std::vector<int> ends(4, 0);
  for (const FeatureChain& chain : network.chains) ++ends[chain.from], ++ends[chain.to];
  for (int n = 0; n < 4; ++n) {
    const Vector2d& p = network.nodes[n];
    if (ends[n] == 3) {
      EXPECT_LT((p - centre).norm(), 0.5) << p.transpose();
    } else {
      EXPECT_EQ(ends[n], 1);
      EXPECT_TRUE(p.x() == 0 || p.x() == 64 || p.y() == 0 || p.y() == 64) << p.transpose();
    }
  }
}

TEST(FeatureChains, NoneInFlatSmoothOrNoisyPictures) {
  const auto none = [](const Raster& picture) { return feature_chains(picture).chains.empty(); };
  EXPECT_TRUE(none(box_filtered(40, 30, kDark, kDark, [](double, double) { return 0; })));
  EXPECT_TRUE(
      none(box_filtered(40, 30, kDark, kBright, [](double x, double y) { return (x + y) / 70; })));
  EXPECT_TRUE(none(box_filtered(60, 60, kDark, kBright, [](double x, double y) {
    return 1 / (1 + std::exp((std::hypot(x - 30, y - 30) - 18) / 2));  // a blurred disc
  })));
  std::mt19937 random(3);
  Raster noisy(60, 60, 3);
  for (float& v : noisy.data) v = 0.5f + 0.04f * (static_cast<float>(random() % 256) / 255 - 0.5f);
  EXPECT_TRUE(none(noisy));
  EXPECT_TRUE(none(Raster(1, 1, 3)));
}

TEST(FeatureChains, OptionsChooseWhichEdgesAreChains) {
  const Raster picture = disc_picture(64, 64, {32, 32}, 20);
  EXPECT_TRUE(feature_chains(picture, {.contrast = 1.1 * kJump}).chains.empty());
  EXPECT_TRUE(feature_chains(disc_picture(32, 32, {16, 16}, 3), {.min_length = 40}).chains.empty());
  EXPECT_THROW(feature_chains(picture, {.contrast = 0}), Error);
  EXPECT_THROW(feature_chains(picture, {.weak_contrast = -1}), Error);
  EXPECT_THROW(feature_chains(picture, {.sharpness = 1.5}), Error);
  EXPECT_TRUE(
      feature_chains(disc_picture(32, 32, {16, 16}, 3), {.min_length = 1e9}).chains.empty());
  for (const double length : {-1.0, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(feature_chains(picture, {.min_length = length}), Error) << length;
  }
}

TEST(FeatureChains, SameForAnyNumberOfThreads) {
  std::mt19937 random(4);
  std::vector<std::array<double, 4>> discs(12);
  for (auto& disc : discs) {
    disc = {random() % 128 + 0.3, random() % 96 + 0.6, 5.0 + random() % 20, random() % 8 / 7.0};
  }
  const Raster picture = box_filtered(128, 96, kDark, kBright, [&](double x, double y) {
    double colour = 0.5;
    for (const auto& [cx, cy, r, c] : discs) {
      if (std::hypot(x - cx, y - cy) < r) colour = c;
    }
    return colour;
  });
  const ChainNetwork one = feature_chains(picture, {}, {.threads = 1});
  EXPECT_GT(one.chains.size(), 8u);
  expect_consistent(one);
  for (const int threads : {2, 4}) {
    const ChainNetwork other = feature_chains(picture, {}, {.threads = threads});
    EXPECT_EQ(other.nodes, one.nodes);
    ASSERT_EQ(other.chains.size(), one.chains.size());
    for (std::size_t c = 0; c < one.chains.size(); ++c) {
      EXPECT_EQ(other.chains[c].points, one.chains[c].points);
      EXPECT_EQ(other.chains[c].contrast, one.chains[c].contrast);
    }
  }
}

}  // namespace
}  // namespace quadrille
