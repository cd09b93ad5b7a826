#pragma once

#include <vector>

#include "document_range_coder.h"
#include "quadrille/quad_mesh.h"

namespace quadrille {

/// A mesh renumbered in the order of a document, and where its half-edges come from. The order of a
/// mesh that was read from a document is its own.
struct OrderedMesh {
  QuadMesh mesh;
  std::vector<int> halfedge_before;  ///< per half-edge of `mesh` that of the mesh given
};

/// Codes who is whose neighbour. Quads are added across one open edge after the other; for each it
/// is coded whether it lies at the border and, for either new corner, whether it is the
/// neighbouring end of the front, new, or which. Contexts are the numbers of quads that the ends of
/// the edge already have, so that regular regions cost next to nothing.
///
/// Where a closed fan has an odd number of quads, its first half-edge decides the signs of twists
/// (see twist_sign()); it is coded as well, and the quads are sorted so that it is the lowest.
OrderedMesh encode_connectivity(RangeEncoder& coder, const QuadMesh& mesh);

/// The mesh, all vertices at the origin. The number of quads must have been checked against the
/// size of the document. Refuses what is not a quad mesh.
QuadMesh decode_connectivity(RangeDecoder& coder, int quad_count);

/// True when the mesh is one that encode_connectivity() can code: fans of at most 254 quads.
bool can_code_connectivity(const QuadMesh& mesh);

}  // namespace quadrille
