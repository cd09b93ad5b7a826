#pragma once

#include <string>
#include <vector>

#include "quadrille/quad_mesh.h"

namespace quadrille::bench {

/// One number per pixel, rows from the top.
struct LabelMap {
  int width = 0, height = 0;
  std::vector<int> label;

  LabelMap(int width, int height)
      : width(width), height(height), label(static_cast<std::size_t>(width) * height, -1) {}
  int& operator()(int x, int y) { return label[static_cast<std::size_t>(y) * width + x]; }
  int operator()(int x, int y) const { return label[static_cast<std::size_t>(y) * width + x]; }
};

/// The quad that holds each pixel's centre. The mesh must tile the picture (see validate()).
LabelMap quad_labels(const QuadMesh& mesh, int width, int height);

/// Non-zero marks a boundary pixel.
struct BoundaryMask {
  int width = 0, height = 0;
  std::vector<unsigned char> marked;
};

/// Pixels whose right or lower neighbour has another label: boundaries are one pixel wide and lie
/// on the left or upper pixel, as in the drawings of the Berkeley segmentation data.
BoundaryMask boundary_of(const LabelMap& labels);

}  // namespace quadrille::bench
