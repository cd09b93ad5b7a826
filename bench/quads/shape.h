#pragma once

#include "quadrille/quad_mesh.h"
#include "quadrille/raster.h"

namespace quadrille::bench {

/// Figures of a mesh's shape.
struct ShapeStatistics {
  double jacobian_min = 0;  ///< over the quads' scaled Jacobians
  double jacobian_p5 = 0;   ///< 5th percentile
  double jacobian_mean = 0;
  double irregular_share = 0;  ///< of the interior vertices, valence other than 4
  double anisotropy_mean = 0;  ///< of anisotropy() over the quads
  double anisotropy_max = 0;
};

ShapeStatistics shape_statistics(const QuadMesh& mesh);

/// The longer over the shorter of a quad's two mean lengths of opposite sides; 1 for a square.
double anisotropy(const QuadMesh& mesh, int quad);

/// The share of the picture's feature pixels (FeatureTensor::edges at full resolution) that have a
/// side of the mesh within a pixel that runs along the feature within 15 degrees.
double aligned_share(const QuadMesh& mesh, const Raster& picture);

}  // namespace quadrille::bench
