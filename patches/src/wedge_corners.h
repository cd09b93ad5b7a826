#pragma once

#include <span>
#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// The corners (half-edges) that share each wedge, ascending.
class WedgeCorners {
 public:
  explicit WedgeCorners(const PatchMesh& patches) : begin_(patches.wedges.size() + 1, 0) {
    const std::vector<int>& wedge_of = patches.wedge_of_corner;
    for (const int w : wedge_of) ++begin_[w + 1];
    for (std::size_t w = 1; w < begin_.size(); ++w) begin_[w] += begin_[w - 1];
    corners_.resize(wedge_of.size());
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t h = 0; h < wedge_of.size(); ++h) {
      corners_[next[wedge_of[h]]++] = static_cast<int>(h);
    }
  }

  std::span<const int> operator[](int wedge) const {
    return {corners_.data() + begin_[wedge], corners_.data() + begin_[wedge + 1]};
  }

 private:
  std::vector<int> begin_, corners_;
};

}  // namespace quadrille
