#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "quadrille/raster.h"
#include "quadrille/scene_layer.h"

namespace quadrille::cli {

/// The faded picture, enlarged, to draw on with anti-aliased strokes. Points are in pixels of the
/// source picture, stroke widths and radii in pixels of the canvas.
class Canvas {
 public:
  /// `fade` in [0, 1] is how much white is mixed in.
  Canvas(const Raster& picture, double zoom, double fade);
  ~Canvas();

  double zoom() const { return zoom_; }

  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Ink& ink, int width = 1);
  void curve(const std::vector<Eigen::Vector2d>& points, const Ink& ink, int width = 1);
  void dot(const Eigen::Vector2d& centre, double radius, const Ink& ink);
  /// A dot with a white rim that stands out on any ground.
  void mark(const Eigen::Vector2d& centre, const Ink& ink);
  /// A ring of a mark's size, for what is no longer there.
  void ring(const Eigen::Vector2d& centre, const Ink& ink);

  struct Tint {
    Ink ink;
    double strength = 0;  ///< 0 leaves the picture, 1 replaces it
  };
  /// Mixes a colour into every pixel of the canvas, chosen by its position in the source picture.
  void tint(const std::function<Tint(double x, double y)>& tint_at);

  Raster raster() const;

 private:
  struct Surface;
  double zoom_;
  std::unique_ptr<Surface> surface_;
};

}  // namespace quadrille::cli
