#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace quadrille {

/// Sets of the numbers 0 to count - 1, each of one number at first. The smallest number of a set
/// stands for it.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(int a, int b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace quadrille
