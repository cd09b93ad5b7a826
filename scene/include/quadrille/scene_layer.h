#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "quadrille/vector_image.h"

namespace quadrille {

/// What there is to see of a picture, its patches and the fields behind them, as plain data: the
/// drawings of `quadrille inspect`, the VTK files and the viewer all show these layers.
/// Coordinates are pixels of the source picture, y down.

/// Red, green, blue in 0..255.
using Ink = std::array<int, 3>;

inline constexpr Ink kRed = {214, 39, 40};
inline constexpr Ink kBlue = {31, 84, 200};
inline constexpr Ink kDark = {40, 40, 48};

/// Named values per point, cell or pixel of a layer.
struct SceneArray {
  enum class Kind {
    number,  ///< any components that do not depend on the axes
    vector,  ///< two components, x and y (down)
    color,   ///< red, green, blue and perhaps alpha: bytes, or floats whose 1 is the byte 255
  };
  using Values =
      std::variant<std::vector<float>, std::vector<std::int32_t>, std::vector<std::uint8_t>>;

  std::string name;
  std::string meaning;  ///< one phrase: what it is, and its unit
  int components = 1;
  Kind kind = Kind::number;
  Values values;  ///< tuple after tuple
};

/// Points, and cells over them.
struct SceneShapes {
  enum class Cell {
    point,    ///< every point is a cell; cell_points stays empty
    line,     ///< polylines of two or more points
    polygon,  ///< three or more corners, in the order that makes the shoelace sum positive
  };
  Cell cell = Cell::point;
  std::vector<Eigen::Vector2d> points;
  std::vector<float> heights;         ///< per point, above the picture's plane; empty for all 0
  std::vector<int> cell_points;       ///< indices of points, cell after cell
  std::vector<int> cell_begin = {0};  ///< where cell c begins in cell_points; #C + 1
  std::vector<SceneArray> point_arrays;
  std::vector<SceneArray> cell_arrays;

  int cell_count() const { return static_cast<int>(cell_begin.size()) - 1; }
  /// Ends the cell whose points were appended to cell_points.
  void end_cell() { cell_begin.push_back(static_cast<int>(cell_points.size())); }
};

/// A grid of pixels over the picture from its top left corner, rows from the top.
struct SceneGrid {
  int width = 0, height = 0;                 ///< pixels of the grid
  double pixel_width = 1, pixel_height = 1;  ///< in pixels of the source picture
  std::vector<SceneArray> arrays;            ///< per pixel of the grid
};

/// The patches themselves, exactly.
struct ScenePatches {
  std::shared_ptr<const VectorImage> image;
  /// Fitting error per patch, layer after layer, or empty when it is not known; see patch_errors().
  std::vector<float> errors;
};

enum class Marker {
  dot,
  mark,   ///< a dot of radius 3.5 with a white rim that stands out on any ground
  ring,   ///< a ring of a mark's size, for what is no longer there
  cross,  ///< both ways along the vectors "axis_u" and "axis_v"
};

/// How a layer is drawn by whoever draws it.
struct SceneStyle {
  Ink ink = kDark;
  /// Name of the byte array of three or four components that gives points, cells or pixels their
  /// own colours; empty when all have the ink. Polygons are filled when they have such an array
  /// and outlined when not.
  std::string colors;
  double width = 1;  ///< of lines and crosses, in pixels of the drawing
  Marker marker = Marker::dot;
  double radius = 1.2;    ///< of dots, in pixels of the drawing
  double arm_length = 1;  ///< of a cross per length of its vectors
};

struct SceneLayer {
  std::string name;     ///< lower case words joined by '-', unique within a group
  std::string summary;  ///< what is shown, one phrase
  SceneStyle style;
  std::variant<SceneShapes, SceneGrid, ScenePatches> content;
};

/// Layers that belong together, in drawing order.
struct SceneGroup {
  std::string name;  ///< as of a layer
  std::string summary;
  std::vector<SceneLayer> layers;
};

/// All that is known of a picture.
struct Scene {
  double width = 0, height = 0;  ///< of the picture, pixels
  std::vector<SceneGroup> groups;
};

}  // namespace quadrille
