#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fit_element.h"

namespace quadrille {

/// Equations over the unknowns of several wedges each, with the same factors in all channels, kept
/// as sparse rows. A product with their normal matrix takes two steps, evaluate() over all rows and
/// gather() for every wedge; both add up in a fixed order.
class WedgeRows {
 public:
  using Vector = std::vector<WedgeUnknowns>;

  /// How one wedge enters one row: factors of value, dx, dy, twist.
  struct Entry {
    int wedge;
    Eigen::Vector4f factors;
  };

  /// Adds an equation whose entries times the patches' colours ought to give `target`; the unknowns
  /// of the system are corrections to these colours. Every wedge comes once. Opaque patches need no
  /// correction of alpha.
  void add(std::span<const Entry> entries, const PatchMesh& patches, const Eigen::Array4d& target);
  /// To be called after the last add().
  void finish(std::size_t wedge_count);

  std::size_t size() const { return residual_.size(); }
  /// What `correction` leaves of the difference of a row's target from what it has.
  Eigen::Vector4f rest(std::size_t row, const Vector& correction) const {
    return residual_[row] - product(row, correction);
  }

  /// Puts the differences of targets from what the wedges have in front of gather().
  void evaluate_residual() { values_ = residual_; }
  /// Puts the rows times x in front of gather().
  void evaluate(const Vector& x);
  /// Adds the wedge's part of the transposed rows times what was evaluated.
  void gather(int wedge, WedgeUnknowns& sum) const;
  /// The wedge's own block of the normal matrix.
  Eigen::Matrix4d block(int wedge) const;

 private:
  /// Kept a second time in this order, because gather() would else read entries all over memory.
  struct WedgeEntry {
    int row;
    Eigen::Vector4f factors;
  };

  std::vector<Entry> entries_;                      // by row
  std::vector<int> row_begin_ = {0};                // #rows + 1
  std::vector<int> wedge_begin_;                    // #W + 1
  std::vector<WedgeEntry> wedge_entries_;           // by wedge, then by row
  std::vector<Eigen::Vector4f> residual_, values_;  // #rows

  Eigen::Vector4f product(std::size_t row, const Vector& x) const {
    Eigen::Vector4f sum = Eigen::Vector4f::Zero();
    for (int i = row_begin_[row]; i < row_begin_[row + 1]; ++i) {
      sum += x[entries_[i].wedge] * entries_[i].factors;
    }
    return sum;
  }
};

}  // namespace quadrille
