#pragma once

#include <vector>

#include "quadrille/cross_field.h"
#include "quadrille/fit.h"
#include "quadrille/position_field.h"
#include "quadrille/quad_extraction.h"
#include "quadrille/scale_field.h"
#include "quadrille/vector_image.h"
#include "quadrille/working_picture.h"

namespace quadrille {

/// More quads than this are refused.
inline constexpr int kMaxQuads = 2'000'000;

struct VectorizeOptions {
  /// Wished number of quads, 1 to kMaxQuads; met within 10 % from 20 quads up.
  int quads = 3000;
  CrossFieldOptions cross_field;
  ScaleOptions scale;
  PositionOptions position;
  FitOptions fit;
  /// Use the plain axis-aligned lattice instead of the fields.
  bool lattice = false;
};

/// The front half's results, each in working pixels but for the mesh.
struct Quadrangulation {
  WorkingPicture working;
  FeatureTensor features;
  CrossField cross;
  ScaleField scale;
  PositionField position;
  QuadMesh mesh;  ///< source pixels
  /// The axis-aligned lattice took the place of the fields' mesh: the picture is smaller than 4
  /// quads a side, its quads are smaller than a pixel, or the count could not be met within 10 %.
  bool fallback = false;
};

struct VectorizeReport {
  int width = 0, height = 0;  ///< source pixels
  int quads = 0, vertices = 0, irregular_vertices = 0;
  int positive_singularities = 0, negative_singularities = 0;
  double misalignment_degrees = 0;
  std::vector<CrossFieldPhase> cross_field_phases;
  int folded = 0;  ///< patches whose geometry is not certified fold-free
  bool fallback = false;
  FitReport fit;
  std::vector<StageReport> stages;
};

struct Vectorization {
  VectorImage image;
  VectorizeReport report;
};

/// Paper section 3: picture to field-aligned pure quad mesh, validated.
/// Throws Error{invalid_argument} for options out of range or a malformed picture,
/// Error{limit_exceeded} above kMaxQuads, Error{cancelled}.
Quadrangulation quadrangulate(const Raster& picture, const VectorizeOptions& options = {},
                              const RunContext& context = {});

/// The whole way: quadrangulate, then the steps of fit_patches(), each reported as a stage. Throws
/// as quadrangulate() does.
Vectorization vectorize(const Raster& picture, const VectorizeOptions& options = {},
                        const RunContext& context = {});

}  // namespace quadrille
