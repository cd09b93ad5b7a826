#pragma once

#include <Eigen/Geometry>
#include <array>

#include "quadrille/render.h"

namespace quadrille::viewer {

/// Where the picture's points lie in a window: the output of render() at `zoom`, with its top left
/// pixel at a whole pixel of the window, so that drawn pixels and screen pixels are the same.
struct Frame {
  double zoom = 1;                     ///< RenderOptions::scale
  std::array<int, 2> output = {1, 1};  ///< size of the whole output, pixels
  Eigen::Array2d scale = {1, 1};       ///< output size / picture size
  Eigen::Array2i origin = {0, 0};      ///< of the output in the window, y down
  Eigen::Array2i window = {1, 1};      ///< size in pixels

  Eigen::Vector2d to_window(const Eigen::Vector2d& p) const {
    return p.array() * scale + origin.cast<double>();
  }
  Eigen::Vector2d to_picture(const Eigen::Vector2d& p) const {
    return (p.array() - origin.cast<double>()) / scale;
  }
  /// The pixels of the output within the window and `margin` pixels around it; none of them is a
  /// region of width or height 0.
  PixelRegion visible(int margin = 0) const;
  /// The same rectangle, not cut off at the picture's sides, in pixels of the source picture.
  Eigen::AlignedBox2d visible_box(int margin = 0) const;
  bool operator==(const Frame&) const;
};

/// What is looked at: a point of the picture in the middle of the window, and the zoom.
class View {
 public:
  static constexpr double kLeastZoom = 1.0 / 64;

  /// The whole picture in the window. Sizes are positive.
  View(const Eigen::Array2d& picture, const Eigen::Array2i& window);

  double zoom() const { return zoom_; }
  /// The largest zoom: outputs have at most 2^30 pixels a side.
  double most_zoom() const;
  const Eigen::Vector2d& center() const { return center_; }
  const Eigen::Array2d& picture() const { return picture_; }
  const Eigen::Array2i& window() const { return window_; }

  /// Keeps the middle and the zoom.
  void resize(const Eigen::Array2i& window) { window_ = window.max(1); }
  /// As large as fits into the window.
  void fit();
  /// Keeps the middle. Zooms out of range become the nearest one in range.
  void zoom_to(double zoom);
  /// Keeps what lies at a point of the window, up to a pixel.
  void zoom_at(const Eigen::Vector2d& point, double factor);
  /// Moves the picture by pixels of the window. The middle never leaves the picture.
  void pan(const Eigen::Vector2d& pixels);
  void look_at(const Eigen::Vector2d& center);

  Frame frame() const;

 private:
  Eigen::Array2d picture_;
  Eigen::Array2i window_;
  Eigen::Vector2d center_;
  double zoom_ = 1;
};

}  // namespace quadrille::viewer
