#pragma once

#include <Eigen/Geometry>

namespace quadrille::viewer {

/// Something for each of the texts over the scene.
template <class T>
struct ForEachPanel {
  T layers, numbers, status, help;
};

/// The font's size in window pixels: smaller in small windows, as long as it can be read.
int panel_font_size(const Eigen::Array2d& window);

/// Where texts of these sizes (0 for those that are not wanted) stand in a window, in its pixels,
/// y up; empty boxes for those that are left out because there is no room: no text ever covers
/// another, or the sliders, whose box may be empty. The status stands at the bottom, the list of
/// layers at the top left, the numbers right of it or else below it or instead of it, the help in
/// the middle and before the list and the numbers.
ForEachPanel<Eigen::AlignedBox2d> lay_out_panels(const ForEachPanel<Eigen::Array2d>& sizes,
                                                 const Eigen::Array2d& window,
                                                 const Eigen::AlignedBox2d& sliders);

}  // namespace quadrille::viewer
