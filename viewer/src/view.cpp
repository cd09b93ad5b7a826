#include "view.h"

#include <algorithm>
#include <cmath>

namespace quadrille::viewer {

using Eigen::Array2d;
using Eigen::Array2i;
using Eigen::Vector2d;

PixelRegion Frame::visible(int margin) const {
  const Array2i size(output[0], output[1]);
  const Array2i low = (-origin - margin).max(0).min(size);
  const Array2i high = (window - origin + margin).max(0).min(size);
  const Array2i extent = (high - low).max(0);
  return {low.x(), low.y(), extent.x(), extent.y()};
}

Eigen::AlignedBox2d Frame::visible_box(int margin) const {
  const Vector2d around = Vector2d::Constant(margin);
  return {to_picture(-around), to_picture(window.cast<double>().matrix() + around)};
}

bool Frame::operator==(const Frame& other) const {
  return zoom == other.zoom && output == other.output && (origin == other.origin).all() &&
         (window == other.window).all();
}

View::View(const Array2d& picture, const Array2i& window)
    : picture_(picture), window_(window.max(1)), center_(picture.matrix() / 2) {
  fit();
}

double View::most_zoom() const { return (1 << 30) / (picture_.maxCoeff() + 1); }

void View::fit() {
  center_ = picture_.matrix() / 2;
  zoom_to((window_.cast<double>() / picture_).minCoeff());
}

void View::zoom_to(double zoom) {
  zoom_ = std::clamp(zoom, std::min(kLeastZoom, most_zoom()), most_zoom());
}

void View::zoom_at(const Vector2d& point, double factor) {
  const Vector2d from_middle = point - window_.cast<double>().matrix() / 2;
  const double before = zoom_;
  zoom_to(zoom_ * factor);
  look_at(center_ + from_middle / before - from_middle / zoom_);
}

void View::pan(const Vector2d& pixels) { look_at(center_ - pixels / zoom_); }

void View::look_at(const Vector2d& center) {
  center_ = center.array().max(0).min(picture_).matrix();
}

Frame View::frame() const {
  Frame frame;
  frame.zoom = zoom_;
  for (int axis = 0; axis < 2; ++axis) {
    frame.output[axis] = std::max(1, static_cast<int>(std::lround(picture_[axis] * zoom_)));
    frame.scale[axis] = frame.output[axis] / picture_[axis];
    frame.origin[axis] =
        static_cast<int>(std::lround(window_[axis] / 2.0 - center_[axis] * frame.scale[axis]));
  }
  frame.window = window_;
  return frame;
}

}  // namespace quadrille::viewer
