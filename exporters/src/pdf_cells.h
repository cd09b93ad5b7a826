#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "quadrille/vector_image.h"
#include "subdivision.h"

namespace quadrille {

/// What a shading shows of a layer: straight colour, alpha as gray, or the colour over white paper.
enum class ShadedQuantity { color, alpha, over_white };

inline int channels_of(ShadedQuantity quantity) {
  return quantity == ShadedQuantity::alpha ? 1 : 3;
}

/// A patch divided into count.u x count.v equal cells of its parameter square, colours bilinear
/// within each.
struct PatchCells {
  Divisions count;
  /// Colours at the corners of the cells in 8-bit steps, (count.u + 1) x (count.v + 1), u fastest;
  /// the first channels count.
  std::vector<std::array<std::uint8_t, 3>> nodes;
};

/// The cells of many patches in little memory; patches without any are not painted.
class CellTable {
 public:
  using Node = std::array<std::uint8_t, 3>;

  explicit CellTable(int quads) : counts_(quads, {0, 0}), first_(quads, 0) {}
  void add(int quad, const PatchCells& cells);
  Divisions count(int quad) const { return {counts_[quad][0], counts_[quad][1]}; }
  const Node& node(int quad, int i, int j) const {
    return nodes_[first_[quad] + j * (counts_[quad][0] + 1) + i];
  }
  Node& node(int quad, int i, int j) {
    return nodes_[first_[quad] + j * (counts_[quad][0] + 1) + i];
  }

 private:
  std::vector<std::array<std::uint8_t, 2>> counts_;
  std::vector<std::size_t> first_;
  std::vector<Node> nodes_;
};

/// The fewest cells per patch whose colours, fitted by least squares, stay within half of
/// `tolerance` (8-bit steps) of the patch's in the root mean square and within twice of it
/// anywhere; straight colours count by their alpha, and what rounding up adds for viewers that cut
/// colours off does not count. Where none of at most 24 x 24 cells about a pixel wide do, as many
/// as that. Fitted bilinear pieces need about half as many cells as pieces that interpolate the
/// colours at their corners.
PatchCells fit_cells(const Layer& layer, int quad, ShadedQuantity quantity, double tolerance);

}  // namespace quadrille
