#pragma once

#include "face_mesh.h"
#include "quadrille/run_context.h"

namespace quadrille {

/// Removes irregular vertices and triangles by local changes that lower the irregularity and pass
/// the guard of GuardedEditor, the largest gain first at each place:
///
/// - Re-division of a chain of faces, each joined to the next by an edge that is not kept: of all
///   divisions of its outline into quads (and a triangle if it has an odd number of corners) the
///   most regular one. Two quads: the rotation of an edge. From a triangle to another, through up
///   to two quads: the pairing of two odd faces. The points stay.
/// - Collapse of an edge or of a quad along a diagonal (and so of doublets), where that still pays.
///
/// Deterministic; the time is linear in the number of faces. Throws Error{cancelled}.
void clean_up(FaceMesh& mesh, const RunContext& context = {});

}  // namespace quadrille
