#include "quadrille/working_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace quadrille {
namespace {

constexpr double kPixelsPerEdge = 14;     // a lattice edge is two quad edges
constexpr double kWorthwhile = 1.25;      // reductions below this blur more than they save
constexpr double kMinPixelsPerEdge = 10;  // below it regions get too few pixels to be told apart

int working_side(int side, double edge) {
  if (edge < kMinPixelsPerEdge) return side * static_cast<int>(std::ceil(kMinPixelsPerEdge / edge));
  const double factor = edge / kPixelsPerEdge;
  if (factor < kWorthwhile) return side;
  return std::max(1, static_cast<int>(std::lround(side / factor)));
}

Raster premultiplied(const Raster& picture) {
  Raster result = picture;
  if (!picture.has_alpha()) return result;
  for (std::size_t i = 0; i < result.data.size(); i += 4) {
    for (int c = 0; c < 3; ++c) result.data[i + c] *= result.data[i + 3];
  }
  return result;
}

}  // namespace

WorkingPicture make_working_picture(const Raster& picture, double edge) {
  WorkingPicture working;
  working.picture = premultiplied(picture);
  const int w = working_side(picture.width, edge), h = working_side(picture.height, edge);
  working.scale_x = static_cast<double>(picture.width) / w;
  working.scale_y = static_cast<double>(picture.height) / h;
  if (w == picture.width && h == picture.height) return working;

  Raster resized(w, h, picture.channels);
  const int type = CV_32FC(picture.channels);
  const cv::Mat source(picture.height, picture.width, type, working.picture.data.data());
  cv::Mat target(h, w, type, resized.data.data());
  cv::resize(source, target, target.size(), 0, 0,
             w < picture.width || h < picture.height ? cv::INTER_AREA : cv::INTER_LINEAR);
  working.picture = std::move(resized);
  return working;
}

}  // namespace quadrille
