#pragma once

#include <cmath>

#include "grid_solver.h"
#include "quadrille/feature_tensor.h"

namespace quadrille {

/// What pulls the cross field toward the picture: sum mass |z - pull / mass|^2.
struct DataTerm {
  FieldGrid<float> mass;  ///< lambda times the feature weight, > 0; large on the picture's border
  ComplexGrid pull;       ///< mass times target
};

/// The cross field as explicit angles in quarter turns, theta / (pi/2), with what pulls at them. In
/// this unit the period jumps p and q of the paper's Eq. 2 are whole numbers, and adding 1 to a
/// pixel changes nothing but the jumps around it.
struct AngleField {
  FieldGrid<float> turns;
  FieldGrid<float> target;  ///< what the data term wants
  FieldGrid<float> mass;    ///< the data term's weight
};

/// lambda times the features' weight and direction; on the border axis-aligned, held strongly.
DataTerm data_term(const FeatureTensor& features, double alignment);

/// The data term of CrossFieldPhase's energy; all angles 0.
AngleField angle_field(const FeatureTensor& features, double alignment, const RunContext& context);
void set_turns(const ComplexGrid& z, AngleField& field, const RunContext& context);

std::complex<float> from_turns(float turns);

inline std::complex<float> unit(std::complex<float> z) {
  const float length = std::sqrt(std::norm(z));
  return length > 1e-20f ? z / length : std::complex<float>(1);
}

/// A difference in quarter turns less its period jump, in [-1/2, 1/2].
inline float principal(float difference) {
  // Adding and taking away 1.5 * 2^23 rounds to the nearest whole number.
  constexpr float kRounder = 12582912.0f;
  return difference - ((difference + kRounder) - kRounder);
}

/// Pixels [x0, x1) x [y0, y1).
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool overlaps(const Window& other) const {
    return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
};

/// The energy of CrossFieldPhase: of the whole field, or its part that the window's pixels have.
double energy(const AngleField& field, const RunContext& context);
double energy(const AngleField& field, const Window& window);

/// Index times 4 of the plaquette between the pixels (x, y) and (x + 1, y + 1), paper Eq. 4.
int quarter_index(const FieldGrid<float>& turns, int x, int y);

}  // namespace quadrille
