#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "subdivision.h"
#include "svg_detail.h"
#include "svg_layer.h"

namespace quadrille {

/// A part of a patch over a box that halving its parameter square again and again leads to.
struct PatchCell {
  int quad;
  ParameterBox box;
};

/// The cells of some patches as a mesh: the sides of cells are divided where corners of others lie
/// on them, so that each side has one cell on its other side. Curves and points are in pixels of
/// the picture.
class CellMesh {
 public:
  /// What lies across a side that has no twin.
  enum class Beyond {
    seam,    ///< smoothly, what is painted earlier: the side shows
    later,   ///< what is painted later, hiding whatever reaches there, or whatever may reach over
    clip,    ///< whatever reaches there is cut off
    nothing  ///< the paint must end exactly here
  };
  struct Side {
    int cell;
    int k;                     ///< of the patch or along it, see side_curve()
    bool on_border;            ///< of the patch
    Eigen::Vector2d from, to;  ///< parameters of the patch
    int next = -1, prev = -1;  ///< around the cell
    int twin = -1;             ///< of the cell on the other side, if that is one of these
    bool is_torn = false;      ///< colours jump to the twin's
    Beyond beyond = Beyond::seam;
    int first_point = 0, point_count = 0;
  };

  /// The cells of a patch follow each other and cover it. Keeps a reference to the layer.
  CellMesh(const SvgLayer& layer, const std::vector<PatchCell>& cells,
           CellPaint paint = CellPaint::color);

  const SvgLayer& layer() const { return layer_; }
  CellPaint paint() const { return paint_; }
  int cell_count() const { return static_cast<int>(side_begin_.size()) - 1; }
  const std::vector<Side>& sides() const { return sides_; }
  const Side& side(int s) const { return sides_[s]; }
  /// The sides of cell c are numbered from side_begin(c) to side_begin(c + 1), around the cell.
  int side_begin(int cell) const { return side_begin_[cell]; }
  int quad(int cell) const { return cells_[cell].quad; }
  PlaneCurve curve(int s) const;
  /// Points of a polyline near the side, from its start on, without its end.
  std::span<const Eigen::Vector2d> points(int s) const {
    return {points_.data() + sides_[s].first_point,
            static_cast<std::size_t>(sides_[s].point_count)};
  }
  /// By how much the paint changes across the side at its i-th point: 8-bit steps per pixel, root
  /// mean square of the channels, by its alpha.
  double slope(int s, int i) const { return slopes_[sides_[s].first_point + i]; }
  /// Parameters of the side's i-th point.
  Eigen::Vector2d parameters(int s, int i) const {
    const Side& side = sides_[s];
    return side.from + (side.to - side.from) * (double(i) / side.point_count);
  }
  const BicubicHermite<Eigen::Vector2d>& geometry(int cell) const {
    return patches_.at(quad(cell)).geometry;
  }
  /// Of a patch, or null when it is none of these.
  const BicubicHermite<Eigen::Vector2d>* find_geometry(int quad) const {
    const auto found = patches_.find(quad);
    return found == patches_.end() ? nullptr : &found->second.geometry;
  }
  /// True when whatever a patch that is painted reaches of another one does not show, or may.
  bool is_hidden_in(int quad, int other) const;
  /// The cell at the origin of half-edge h in its quad, or -1 when the quad is none of these.
  int cell_at(int h) const;
  /// A cell of a patch that holds these parameters, or -1 when the quad is none of these.
  int cell_with(int quad, const Eigen::Vector2d& uv) const;

 private:
  struct Patch {
    BicubicHermite<Eigen::Vector2d> geometry;
    BicubicHermite<Color> color;
    BicubicBezier<Eigen::Vector2d> bezier;
    int first_cell = 0, cell_count = 0;
    std::array<int, 4> corner_cell{};
  };
  /// Places along a line of the parameter square at which sides of cells end.
  std::vector<double> ends_along(const Patch& patch, int k, double at) const;
  std::vector<double> ends_along_side(int quad, int k) const;
  void add_sides(int cell);
  void add_side(int cell, int k, bool on_border, const Eigen::Vector2d& from,
                const Eigen::Vector2d& to);
  void link_twins();
  Beyond beyond(int quad, int k) const;
  bool is_outline(int h) const;
  double slope_across(const Patch& patch, int k, const Eigen::Vector2d& uv) const;

  const SvgLayer& layer_;
  CellPaint paint_;
  std::vector<PatchCell> cells_;
  std::unordered_map<int, Patch> patches_;  ///< by quad
  std::vector<Side> sides_;
  std::vector<int> side_begin_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> slopes_;  ///< at the points
};

}  // namespace quadrille
