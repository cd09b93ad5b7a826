#include "canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace quadrille::cli {
namespace {

constexpr int kFractionBits = 4;  // of the fixed-point coordinates that OpenCV draws with

cv::Scalar to_scalar(const Ink& ink) { return cv::Scalar(ink[0], ink[1], ink[2]); }

/// The picture over white, mixed with white, 8 bit.
cv::Mat faded(const Raster& picture, double fade) {
  cv::Mat pixels(picture.height, picture.width, CV_8UC3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const float* source = picture.pixel(x, y);
      const float alpha = picture.has_alpha() ? source[3] : 1.0f;
      for (int c = 0; c < 3; ++c) {
        const double over_white = 1 + alpha * (source[c] - 1.0);
        pixels.at<cv::Vec3b>(y, x)[c] =
            cv::saturate_cast<uchar>(255 * (fade + (1 - fade) * over_white));
      }
    }
  }
  return pixels;
}

}  // namespace

struct Canvas::Surface {
  cv::Mat pixels;
  double zoom_x, zoom_y;  // effective, after rounding the size

  /// OpenCV's fixed-point coordinates, whose whole numbers are pixel centres.
  cv::Point place(const Eigen::Vector2d& p) const {
    const double unit = 1 << kFractionBits;
    return {static_cast<int>(std::lround((p.x() * zoom_x - 0.5) * unit)),
            static_cast<int>(std::lround((p.y() * zoom_y - 0.5) * unit))};
  }
};

Canvas::Canvas(const Raster& picture, double zoom, double fade)
    : zoom_(zoom), surface_(std::make_unique<Surface>()) {
  const cv::Size size(std::max(1, static_cast<int>(std::lround(picture.width * zoom))),
                      std::max(1, static_cast<int>(std::lround(picture.height * zoom))));
  cv::resize(faded(picture, fade), surface_->pixels, size, 0, 0,
             zoom < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  surface_->zoom_x = static_cast<double>(size.width) / picture.width;
  surface_->zoom_y = static_cast<double>(size.height) / picture.height;
}

Canvas::~Canvas() = default;

void Canvas::line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Ink& ink, int width) {
  cv::line(surface_->pixels, surface_->place(a), surface_->place(b), to_scalar(ink), width,
           cv::LINE_AA, kFractionBits);
}

void Canvas::curve(const std::vector<Eigen::Vector2d>& points, const Ink& ink, int width) {
  std::vector<cv::Point> placed;
  for (const Eigen::Vector2d& p : points) placed.push_back(surface_->place(p));
  cv::polylines(surface_->pixels, placed, /*isClosed=*/false, to_scalar(ink), width, cv::LINE_AA,
                kFractionBits);
}

void Canvas::dot(const Eigen::Vector2d& centre, double radius, const Ink& ink) {
  cv::circle(surface_->pixels, surface_->place(centre),
             static_cast<int>(std::lround(radius * (1 << kFractionBits))), to_scalar(ink),
             cv::FILLED, cv::LINE_AA, kFractionBits);
}

void Canvas::mark(const Eigen::Vector2d& centre, const Ink& ink) {
  dot(centre, 5, {255, 255, 255});
  dot(centre, 3.5, ink);
}

void Canvas::ring(const Eigen::Vector2d& centre, const Ink& ink) {
  dot(centre, 5, {255, 255, 255});
  cv::circle(surface_->pixels, surface_->place(centre),
             static_cast<int>(3.5 * (1 << kFractionBits)), to_scalar(ink), 1, cv::LINE_AA,
             kFractionBits);
}

void Canvas::tint(const std::function<Tint(double x, double y)>& tint_at) {
  cv::Mat& pixels = surface_->pixels;
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      const Tint tint = tint_at((x + 0.5) / surface_->zoom_x, (y + 0.5) / surface_->zoom_y);
      cv::Vec3b& pixel = pixels.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) {
        pixel[c] = cv::saturate_cast<uchar>(pixel[c] + tint.strength * (tint.ink[c] - pixel[c]));
      }
    }
  }
}

Raster Canvas::raster() const {
  const cv::Mat& pixels = surface_->pixels;
  Raster picture(pixels.cols, pixels.rows, 3);
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        picture.pixel(x, y)[c] = pixels.at<cv::Vec3b>(y, x)[c] / 255.0f;
      }
    }
  }
  return picture;
}

}  // namespace quadrille::cli
