#include "output_frame.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "quadrille/error.h"

namespace quadrille {
namespace {

constexpr double kLargestSide = 0x1p30;
constexpr double kMostPixels = 0x1p32;  // of one region

bool positive(double x) { return std::isfinite(x) && x > 0; }

int checked_side(double side, const char* name) {
  const double rounded = std::max(1.0, std::round(side));
  if (!(rounded <= kLargestSide)) {
    throw Error(ErrorCode::limit_exceeded,
                std::string("the output's ") + name +
                    " would be above 2^30 pixels; choose a smaller scale");
  }
  return static_cast<int>(rounded);
}

int power_of_two_at_least(double x) {
  int k = 1;
  while (k < x) k *= 2;
  return k;
}

/// Factor that the options ask for, before the output is rounded to whole pixels.
double nominal_scale(const VectorImage& image, const RenderOptions& options, int axis) {
  const int given[2] = {options.width, options.height};
  const double side[2] = {image.width, image.height};
  if (given[axis] != 0) return given[axis] / side[axis];
  if (given[1 - axis] != 0) return given[1 - axis] / side[1 - axis];
  return options.scale;
}

}  // namespace

std::array<int, 2> output_size(const VectorImage& image, const RenderOptions& options) {
  if (!positive(image.width) || !positive(image.height)) {
    throw Error(ErrorCode::invalid_argument,
                "a picture of " + std::to_string(image.width) + " x " +
                    std::to_string(image.height) +
                    " pixels cannot be drawn; its sides must be positive");
  }
  if (options.width < 0 || options.height < 0) {
    throw Error(
        ErrorCode::invalid_argument,
        "an output of " + std::to_string(options.width) + " x " + std::to_string(options.height) +
            " pixels cannot be drawn; give positive sides, or 0 for a side to be worked out");
  }
  if (options.width == 0 && options.height == 0 && !positive(options.scale)) {
    throw Error(ErrorCode::invalid_argument,
                "a scale of " + std::to_string(options.scale) +
                    " is not possible; give a positive, finite number");
  }
  const int width = checked_side(
      options.width ? options.width : image.width * nominal_scale(image, options, 0), "width");
  const int height = checked_side(
      options.height ? options.height : image.height * nominal_scale(image, options, 1), "height");
  return {width, height};
}

OutputFrame output_frame(const VectorImage& image, const RenderOptions& options) {
  const auto [width, height] = output_size(image, options);
  OutputFrame frame{width, height};
  const double side[2] = {image.width, image.height};
  const int pixels[2] = {width, height};
  for (int axis = 0; axis < 2; ++axis) {
    // The rounded size may ask for slightly more samples than the nominal scale, or, for thin
    // pictures whose side became one pixel, for far fewer.
    const double reduction =
        std::min(1 / nominal_scale(image, options, axis), std::ceil(side[axis]) / pixels[axis]);
    frame.box[axis] = power_of_two_at_least(std::min(reduction, kLargestSide));
    if (double(pixels[axis]) * frame.box[axis] > kLargestSide) {
      throw Error(ErrorCode::limit_exceeded, "a picture side of " + std::to_string(side[axis]) +
                                                 " pixels is above 2^30; scale the picture down");
    }
    frame.scale[axis] = pixels[axis] / side[axis] * frame.box[axis];
  }
  frame.region = options.region.value_or(PixelRegion{0, 0, width, height});
  const PixelRegion& r = frame.region;
  if (r.x < 0 || r.y < 0 || r.width < 1 || r.height < 1 || r.x > width - r.width ||
      r.y > height - r.height) {
    throw Error(ErrorCode::invalid_argument,
                "the region " + std::to_string(r.x) + "," + std::to_string(r.y) + "," +
                    std::to_string(r.width) + "," + std::to_string(r.height) +
                    " is not inside the " + std::to_string(width) + " x " + std::to_string(height) +
                    " output; choose one that is");
  }
  if (double(r.width) * r.height > kMostPixels) {
    throw Error(ErrorCode::limit_exceeded, "a region of " + std::to_string(r.width) + " x " +
                                               std::to_string(r.height) +
                                               " pixels is above 2^32; draw it in parts");
  }
  return frame;
}

}  // namespace quadrille
