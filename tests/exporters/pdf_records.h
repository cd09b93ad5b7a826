#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pdf_layer.h"
#include "support/programs.h"

namespace quadrille::test {

/// A Coons patch as ISO 32000-1, 8.7.4.5.7, has it: 12 points around it, colours at every third.
struct ReadPatch {
  std::array<Eigen::Vector2d, 12> points;
  std::array<std::array<int, 3>, 4> colors;
  bool shares_side = false;  ///< with the patch before
};

/// What /FlateDecode with /Predictor 12 makes of the stream.
std::vector<std::uint8_t> inflated(ScratchFile& scratch, const CoonsShading& shading);

std::vector<ReadPatch> patches_in(const std::vector<std::uint8_t>& data,
                                  const CoordinateGrid& grid);

/// An opaque layer that fills the page, as a PDF paints it.
struct Painted {
  ScratchFile scratch{scratch_dir() / "painted.pdf"};
  PaintedLayer layer;

  Painted(const Layer& drawn, double tolerance)
      : layer(paint_layer(drawn, true, Transparency::soft_mask, tolerance, scratch, {},
                          [](double) {})) {}
  /// The patches of the first shading.
  std::vector<ReadPatch> read() {
    return patches_in(inflated(scratch, layer.parts.at(0).color.at(0).shading), layer.grid);
  }
};

}  // namespace quadrille::test
