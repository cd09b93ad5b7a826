#pragma once

#include "quadrille/position_field.h"
#include "quadrille/quad_mesh.h"

namespace quadrille {

/// Pure quad mesh of the rectangle [0, width] x [0, height] (source pixels) from the fields:
/// regions of pixels that share a lattice point become vertices, shifts of one become edges, their
/// constrained Delaunay triangulation is merged into convex faces, chains of faces are re-divided
/// to be more regular, every face is divided once (an n-gon into n quads), and badly shaped quads
/// are smoothed. The faces tile the rectangle and keep their orientation whatever the fields are;
/// see validate().
QuadMesh extract_quads(const FeatureTensor& features, const CrossField& field,
                       const ScaleField& scale, const PositionField& positions, double width,
                       double height, const RunContext& context = {});

/// Axis-aligned lattice of columns x rows equal quads over [0, width] x [0, height]: the fallback
/// for any picture and the baseline of the benchmarks.
QuadMesh lattice_mesh(double width, double height, int columns, int rows);

/// The lattice with about `quads` cells that are as square as possible.
QuadMesh lattice_mesh(double width, double height, int quads);

}  // namespace quadrille
