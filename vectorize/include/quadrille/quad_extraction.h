#pragma once

#include "quadrille/feature_chains.h"
#include "quadrille/planar_loops.h"
#include "quadrille/position_field.h"
#include "quadrille/quad_mesh.h"

namespace quadrille {

/// Pure quad mesh of the rectangle [0, width] x [0, height] (source pixels) from the fields:
/// regions of pixels that share a lattice point become vertices, shifts of one become edges, their
/// constrained Delaunay triangulation is merged into convex faces, chains of faces are re-divided
/// to be more regular, every face is divided once (an n-gon into n quads), and badly shaped quads
/// are smoothed. The faces tile the rectangle and keep their orientation whatever the fields are;
/// see validate(). Chains are constraints of the triangulation: the mesh's edges follow them and
/// carry kFeatureEdge, but for pieces that come within a pixel or two of a stronger chain's.
QuadMesh extract_quads(const FeatureTensor& features, const CrossField& field,
                       const ScaleField& scale, const PositionField& positions,
                       const ChainNetwork& chains, double width, double height,
                       const RunContext& context = {});

/// Pure quad mesh of the area inside an outline such as alpha_outline() gives: the loops,
/// simplified to edges of about the lattice's length with their corners kept, are constraints of
/// the triangulation, triangles outside of them are left out, and the border vertices lie on the
/// outline. Loops stay apart from each other and from themselves whatever the edge length; see
/// validate_region(). The outline must not be empty.
QuadMesh extract_quads(const FeatureTensor& features, const CrossField& field,
                       const ScaleField& scale, const PositionField& positions,
                       const std::vector<Loop>& outline, double width, double height,
                       const RunContext& context = {});

/// Axis-aligned lattice of columns x rows equal quads over [0, width] x [0, height]: the fallback
/// for any picture and the baseline of the benchmarks.
QuadMesh lattice_mesh(double width, double height, int columns, int rows);

/// The lattice with about `quads` cells that are as square as possible.
QuadMesh lattice_mesh(double width, double height, int quads);

/// The same lattice, cells of about `edge` pixels a side, trimmed by an outline and divided like
/// the fields' mesh: each whole cell becomes four quads.
QuadMesh lattice_mesh(const std::vector<Loop>& outline, double width, double height, double edge);

}  // namespace quadrille
