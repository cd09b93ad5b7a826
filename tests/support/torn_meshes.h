#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "quadrille/quad_mesh.h"
#include "quadrille/raster.h"

namespace quadrille::testing {

/// A disc in a picture: a square block of columns x columns quads in the disc's middle, rings of
/// quads up to the circle, and rings from there to the border of the picture.
struct DiscMesh {
  QuadMesh mesh;
  std::vector<int> circle;  ///< the edges along the circle, in order
};
DiscMesh disc_mesh(int columns, int rings_inside, int rings_outside, double width, double height,
                   const Eigen::Vector2d& center, double radius);

/// A lattice whose middle column of vertices lies on the line from (top, 0) to (bottom, height).
/// `edges` are its edges there from the top down.
struct SplitMesh {
  QuadMesh mesh;
  std::vector<int> line;
};
SplitMesh split_mesh(int columns, int rows, double width, double height, double top, double bottom);

/// Edge number of the edge between two neighbouring vertices; -1 when there is none.
int edge_between(const QuadMesh& mesh, int a, int b);

void tear(QuadMesh& mesh, std::span<const int> edges);

/// Premultiplied colour and alpha at a point.
using PremultipliedPainter = std::function<Eigen::Array4d(double x, double y)>;

/// The means over division x division points of each pixel, as straight colours.
Raster paint_box_filtered(int width, int height, int channels, int division,
                          const PremultipliedPainter& painter);

}  // namespace quadrille::testing
