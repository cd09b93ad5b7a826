#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// The grid of positions: multiples of 2^-exponent pixels, and the picture's sides exactly.
class PositionGrid {
 public:
  PositionGrid(int exponent, double width, double height)
      : step_(std::ldexp(1.0, -exponent)),
        side_{width, height},
        last_{std::ceil(width / step_), std::ceil(height / step_)} {}

  /// The sides are numbers that an int holds with room to spare, and no distance between positions
  /// is so small that its square vanishes.
  bool is_usable() const { return is_usable(0) && is_usable(1); }
  double step() const { return step_; }
  /// Number of the far side of the picture along an axis.
  int last(int axis) const { return static_cast<int>(last_[axis]); }
  double at(int axis, int n) const { return n == last_[axis] ? side_[axis] : n * step_; }
  Eigen::Vector2d at(const Eigen::Vector2i& n) const { return {at(0, n.x()), at(1, n.y())}; }
  int nearest(int axis, double x) const {
    return static_cast<int>(x == side_[axis] ? last_[axis] : std::floor(x / step_ + 0.5));
  }

 private:
  double step_;
  std::array<double, 2> side_, last_;

  bool is_usable(int axis) const {
    constexpr double kMost = 1 << 24;
    return last_[axis] < kMost && side_[axis] > step_ / kMost;
  }
};

/// How an edge's tangents follow from the vertices: those of set_bessel_tangents(), drawn toward
/// the chord as guard_folds() does, or those of set_bessel_tangents() plus multiples of
/// kTangentSteps position steps.
struct EdgeShape {
  static constexpr int kFree = 5;
  static constexpr int kStraight = 4;
  int level = 0;                   ///< 0 to 4: kKeep[level] of the deviation from the chord
  std::array<int, 4> deviation{};  ///< only for kFree
  bool operator==(const EdgeShape&) const = default;
};
inline constexpr std::array<double, 5> kKeep = {1, 0.75, 0.5, 0.25, 0};
inline constexpr double kTangentSteps = 4;

/// Colour kinds of a wedge, in the order in which they are coded.
enum WedgeKind { kValue, kAlongX, kAlongY, kTwist };
/// Channels: luma, red against blue, green against magenta, alpha; orthogonal in RGB.
inline constexpr int kChannels = 4, kAlpha = 3;
using WedgeCode = std::array<std::array<int, 4>, kChannels>;  ///< [channel][kind]

/// The four kinds of a wedge, all channels, in the units of ColorSteps.
using LocalColors = std::array<Eigen::Array4d, 4>;

using EdgeTangents = std::array<Eigen::Vector2d, 2>;

/// A PatchMesh in integers.
struct QuantizedPatches {
  QuadMesh mesh;  ///< with the positions of the points and the flags of its edges
  std::vector<Eigen::Vector2i> points;
  std::vector<EdgeTangents> tangents;  ///< #E, of the shapes
  std::vector<EdgeShape> shapes;       ///< #E
  std::vector<int> wedge_of_corner;    ///< as straight_patches() numbers them
  std::vector<WedgeCode> wedges;
  bool opaque = true;  ///< then alpha is left out
};

/// The local frame of a vertex makes derivatives comparable with values: multiplied by `root`, the
/// square root of the mean of (edge)(edge)^T over its edges times 2, a gradient becomes a
/// difference of colour along an edge; multiplied by `area`, a twist does.
struct ColorFrame {
  Eigen::Matrix2d root, inverse;
  double area = 1;
};
/// Depends on positions only, by operations that every machine rounds alike.
std::vector<ColorFrame> color_frames(const QuadMesh& mesh, double position_step);

/// Colours as mean, R - B and G - (R + B) / 2; alpha stays.
Eigen::Array4d channels_of(const Color& rgba);
Color color_of(const Eigen::Array4d& channels);

/// Of a wedge that moves by `moved` along its gradient.
LocalColors local_colors(const Wedge& w, const ColorFrame& frame, const Eigen::Vector2d& moved);

/// Sizes of the steps of all colour numbers. The picture's mean absolute error is smallest for its
/// bits when all wedges have the same share in it: a wedge's step is the mean area of the wedges
/// divided by its own; without any area all are alike. Depends on positions only, by operations
/// that every machine rounds alike.
class ColorSteps {
 public:
  /// `step`: of the value of white, for a wedge of mean area; 1 is white.
  ColorSteps(const QuadMesh& mesh, const std::vector<int>& wedge_of_corner, std::size_t wedge_count,
             double step);
  void set_step(double step);
  double operator()(int wedge, int channel, WedgeKind kind) const {
    return scale_[wedge] * of_[channel][kind];
  }
  /// 1 for a wedge of mean area.
  double scale(int wedge) const { return scale_[wedge]; }

 private:
  std::vector<double> scale_;
  std::array<std::array<double, 4>, kChannels> of_;
};

/// Mesh, tangents and wedge numbers; the colours are black.
PatchMesh geometry_of(const QuantizedPatches& quantized);

/// True when quantize() can hold the patches: finite numbers within 2^24 steps.
bool can_quantize(const PatchMesh& patches, const PositionGrid& grid, double color_step);

PatchMesh dequantize(const QuantizedPatches& quantized, const PositionGrid& grid,
                     double color_step);

}  // namespace quadrille
