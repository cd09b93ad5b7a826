#pragma once

#include <optional>

#include "quadrille/vectorize.h"
#include "stage_clock.h"

namespace quadrille {

inline constexpr double kCloseEnough = 0.049;  ///< of the wished count
/// An outline may need more quads than wished, whatever the lattice.
inline constexpr int kOutlineRounds = 6;

/// How a mesh of the wished count is looked for.
struct CountWish {
  FieldGrid<float> density;           ///< see ScaleOptions::density; instead of the options'
  double tolerance = kCloseEnough;    ///< relative miss of the count that is good enough
  std::optional<double> first_guess;  ///< lattice cells
};

double relative_miss(int quads, int wished);

/// True for a mesh that tiles the rectangle, or the region inside the outline.
bool is_valid(const QuadMesh& mesh, const std::vector<Loop>& outline, const Raster& picture);

/// The wished density at the working pixels from the options' map.
FieldGrid<float> wished_density(const Quadrangulation& fields, const VectorizeOptions& options);

/// Scales, positions and quads for the solved cross field, repeated with corrected scales until the
/// count is close to the wished one; keeps the closest valid mesh.
void mesh_to_count(Quadrangulation& fields, const Raster& picture, double edge,
                   const VectorizeOptions& options, const CountWish& wish, StageClock& clock,
                   const RunContext& context);

}  // namespace quadrille
