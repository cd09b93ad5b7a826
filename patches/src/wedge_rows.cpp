#include "wedge_rows.h"

#include <numeric>

#include "parallel_ranges.h"

namespace quadrille {

void WedgeRows::add(std::span<const Entry> entries, const PatchMesh& patches,
                    const Eigen::Array4d& target) {
  Eigen::Array4d rest = target;
  for (const Entry& e : entries) {
    const Wedge& w = patches.wedges[e.wedge];
    rest -= (w.value * e.factors[0] + w.dx * e.factors[1] + w.dy * e.factors[2] +
             w.twist * e.factors[3])
                .cast<double>();
  }
  if (patches.opaque) rest.w() = 0;
  residual_.push_back(rest.matrix().cast<float>());
  entries_.insert(entries_.end(), entries.begin(), entries.end());
  row_begin_.push_back(static_cast<int>(entries_.size()));
}

void WedgeRows::finish(std::size_t wedge_count) {
  values_.resize(residual_.size());
  wedge_begin_.assign(wedge_count + 1, 0);
  for (const Entry& e : entries_) ++wedge_begin_[e.wedge + 1];
  std::partial_sum(wedge_begin_.begin(), wedge_begin_.end(), wedge_begin_.begin());
  wedge_entries_.resize(entries_.size());
  std::vector<int> next(wedge_begin_.begin(), wedge_begin_.end() - 1);
  for (std::size_t r = 0; r + 1 < row_begin_.size(); ++r) {
    for (int i = row_begin_[r]; i < row_begin_[r + 1]; ++i) {
      wedge_entries_[next[entries_[i].wedge]++] = {static_cast<int>(r), entries_[i].factors};
    }
  }
}

void WedgeRows::evaluate(const Vector& x) {
  for_each_range(static_cast<int>(values_.size()), [&](int begin, int end) {
    for (int r = begin; r < end; ++r) values_[r] = product(r, x);
  });
}

void WedgeRows::gather(int wedge, WedgeUnknowns& sum) const {
  for (int i = wedge_begin_[wedge]; i < wedge_begin_[wedge + 1]; ++i) {
    sum += values_[wedge_entries_[i].row] * wedge_entries_[i].factors.transpose();
  }
}

Eigen::Matrix4d WedgeRows::block(int wedge) const {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (int i = wedge_begin_[wedge]; i < wedge_begin_[wedge + 1]; ++i) {
    const Eigen::Vector4d f = wedge_entries_[i].factors.cast<double>();
    sum += f * f.transpose();
  }
  return sum;
}

}  // namespace quadrille
