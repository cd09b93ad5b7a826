#include "chain_separation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "chain_curve.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kNodeReach = 3;  // in distances: beside a shared node chains may be near

/// Points of the accepted chains in square cells of the size of the distance.
class NearPoints {
 public:
  explicit NearPoints(double distance) : distance_(distance) {}

  void add(const Vector2d& p, int chain) { cells_[key(p, 0, 0)].push_back({p, chain}); }

  /// True when `is_harmful(chain)` for some point within the distance.
  template <class Test>
  bool any_near(const Vector2d& p, const Test& is_harmful) const {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const auto found = cells_.find(key(p, i, j));
        if (found == cells_.end()) continue;
        for (const Point& q : found->second) {
          if ((q.place - p).norm() < distance_ && is_harmful(q.chain)) return true;
        }
      }
    }
    return false;
  }

 private:
  struct Point {
    Vector2d place;
    int chain;
  };
  double distance_;
  std::unordered_map<long long, std::vector<Point>> cells_;

  long long key(const Vector2d& p, int i, int j) const {
    const auto x = static_cast<long long>(std::floor(p.x() / distance_)) + i;
    const auto y = static_cast<long long>(std::floor(p.y() / distance_)) + j;
    return y * (1LL << 32) + x;
  }
};

class Separator {
 public:
  Separator(const ChainNetwork& network, double distance, double min_length)
      : network_(network),
        distance_(distance),
        min_length_(min_length),
        near_(distance),
        result_{network.nodes, {}} {}

  ChainNetwork run() {
    std::vector<int> order(network_.chains.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return network_.chains[a].contrast > network_.chains[b].contrast;
    });
    for (const int c : order) divide(network_.chains[c]);
    return std::move(result_);
  }

 private:
  const ChainNetwork& network_;
  double distance_, min_length_;
  NearPoints near_;
  ChainNetwork result_;

  bool is_covered(const FeatureChain& chain, const Vector2d& p) const {
    const auto is_beside = [&](int node) {
      return (result_.nodes[node] - p).norm() < kNodeReach * distance_;
    };
    return near_.any_near(p, [&](int other) {
      const FeatureChain& o = result_.chains[other];
      for (const int node : {chain.from, chain.to}) {
        if ((node == o.from || node == o.to) && is_beside(node)) return false;
      }
      return true;
    });
  }

  void divide(const FeatureChain& chain) {
    std::vector<char> covered;
    for (const Vector2d& p : chain.points) covered.push_back(is_covered(chain, p));
    const int n = static_cast<int>(chain.points.size());
    for (int begin = 0; begin < n;) {
      int end = begin;
      while (end < n && !covered[end]) ++end;
      if (end - begin >= 2) add(chain, begin, end);
      begin = end + 1;
    }
  }

  void add(const FeatureChain& chain, int begin, int end) {
    const int n = static_cast<int>(chain.points.size());
    FeatureChain piece = chain;
    piece.points.assign(chain.points.begin() + begin, chain.points.begin() + end);
    piece.length = arc_lengths(piece.points).back();
    if (end - begin < n && piece.length < min_length_) return;
    const auto free_end = [&](const Vector2d& p) {
      result_.nodes.push_back(p);
      return static_cast<int>(result_.nodes.size()) - 1;
    };
    if (begin > 0) piece.from = free_end(piece.points.front());
    if (end < n) piece.to = free_end(piece.points.back());
    const int number = static_cast<int>(result_.chains.size());
    for (std::size_t i = 0; i < piece.points.size(); ++i) {
      near_.add(piece.points[i], number);
      if (i > 0) near_.add(0.5 * (piece.points[i - 1] + piece.points[i]), number);
    }
    result_.chains.push_back(std::move(piece));
  }
};

}  // namespace

void separate_chains(ChainNetwork& network, double distance, double min_length) {
  network = Separator(network, distance, min_length).run();
}

}  // namespace quadrille
