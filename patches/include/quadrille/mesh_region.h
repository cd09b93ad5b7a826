#pragma once

#include <vector>

#include "quadrille/planar_loops.h"
#include "quadrille/quad_mesh.h"

namespace quadrille {

/// The border of the mesh as loops of vertices with the mesh on the positive side, in the order of
/// their lowest half-edges.
std::vector<std::vector<int>> border_loops(const QuadMesh& mesh);

/// What a planar mesh covers.
struct MeshRegionSize {
  int components = 0;         ///< connected parts
  int holes = 0;              ///< over all components
  double area = 0;            ///< square pixels inside the border polygon
  double outline_length = 0;  ///< pixels, around components and holes
};
MeshRegionSize region_size(const QuadMesh& mesh);

/// Per quad the number of its smooth region: quads are of the same one when a way between them
/// crosses no tear. Regions are numbered by their lowest quads, from 0.
std::vector<int> smooth_regions(const QuadMesh& mesh);

/// Lists where the mesh fails to be a tiling of some part of the rectangle [0, width] x [0,
/// height], with any number of components and holes: a coordinate is not finite ("not finite") or
/// outside of the rectangle ("outside"), a corner angle is not in (0, pi) ("corner"), V - E + F
/// differs from components minus holes ("euler"), two border edges touch or cross ("border"; the
/// element is a vertex), or the loops of the border are not nested as those of an area ("nesting").
/// Together these mean that the quads cover the area inside the border exactly once. Empty means
/// valid.
std::vector<MeshViolation> validate_region(const QuadMesh& mesh, double width, double height);

}  // namespace quadrille
