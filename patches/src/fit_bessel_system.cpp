#include "fit_bessel_system.h"

#include <Eigen/Dense>

#include "parallel_ranges.h"

namespace quadrille {

BesselSystem::BesselSystem(ColorSystem& system, const PatchMesh& patches)
    : system_(system),
      terms_(bessel_terms(patches)),
      users_(terms_.size()),
      wedges_(terms_.size()),
      products_(terms_.size()),
      inverse_blocks_(terms_.size(), Eigen::Matrix4f::Zero()) {
  for (int w = 0; w < system.wedge_count(); ++w) {
    for (int i = 0; i < static_cast<int>(terms_[w].size()); ++i) {
      users_[terms_[w][i].sample].push_back({w, i});
    }
  }
  right_hand_side.resize(terms_.size());
  samples_of(system.right_hand_side, right_hand_side);
  // The diagonal of B^T A B without what different wedges share; A's own blocks are kept inverted.
  for_each_range(wedge_count(), [&](int begin, int end) {
    for (int s = begin; s < end; ++s) {
      double sum = 0;
      for (const auto& [w, i] : users_[s]) {
        const Eigen::Matrix4d block = system_.inverse_block(w).cast<double>().inverse();
        const Eigen::Vector3d factors = terms_[w][i].factors.cast<double>();
        sum += factors.dot(block.topLeftCorner<3, 3>() * factors);
      }
      inverse_blocks_[s](0, 0) = static_cast<float>(1 / sum);
    }
  });
}

void BesselSystem::wedges_of(const Vector& samples, Vector& wedges) const {
  for_each_range(wedge_count(), [&](int begin, int end) {
    for (int w = begin; w < end; ++w) {
      wedges[w].setZero();
      for (const BesselTerm& t : terms_[w]) {
        wedges[w].leftCols<3>() += samples[t.sample].col(0) * t.factors.transpose();
      }
    }
  });
}

void BesselSystem::samples_of(const Vector& wedges, Vector& samples) const {
  for_each_range(wedge_count(), [&](int begin, int end) {
    for (int s = begin; s < end; ++s) {
      samples[s].setZero();
      for (const auto& [w, i] : users_[s]) {
        samples[s].col(0) += wedges[w].leftCols<3>() * terms_[w][i].factors;
      }
    }
  });
}

Eigen::Array4d BesselSystem::multiply(const Vector& x, Vector& product) {
  wedges_of(x, wedges_);
  const Eigen::Array4d dots = system_.multiply(wedges_, products_);
  samples_of(products_, product);
  return dots;
}

}  // namespace quadrille
