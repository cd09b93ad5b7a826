#pragma once

#include "fit_bessel.h"
#include "fit_system.h"

namespace quadrille {

/// The normal equations of a ColorSystem restricted to the colours that the Bessel scheme makes of
/// one sample per wedge: B^T A B for wedges = B samples. The unknown is column 0; the others stay
/// zero. Its preconditioner is a diagonal.
class BesselSystem : public NormalEquations {
 public:
  /// Keeps a reference to the system, whose right-hand side it takes.
  BesselSystem(ColorSystem& system, const PatchMesh& patches);

  Eigen::Array4d multiply(const Vector& x, Vector& product) override;
  const Eigen::Matrix4f& inverse_block(int wedge) const override { return inverse_blocks_[wedge]; }

  /// The unknowns of the wedges for samples in column 0.
  void wedges_of(const Vector& samples, Vector& wedges) const;

 private:
  ColorSystem& system_;
  std::vector<std::vector<BesselTerm>> terms_;          // by wedge
  std::vector<std::vector<std::array<int, 2>>> users_;  // by sample: wedge, index of the term
  Vector wedges_, products_;
  std::vector<Eigen::Matrix4f> inverse_blocks_;

  void samples_of(const Vector& wedges, Vector& samples) const;
};

}  // namespace quadrille
