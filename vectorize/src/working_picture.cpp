#include "quadrille/working_picture.h"

#include <algorithm>
#include <cmath>

#include "reduced_picture.h"

namespace quadrille {
namespace {

constexpr double kPixelsPerEdge = 10;  // a lattice edge is two quad edges
// The fields take about 200 bytes a working pixel.
constexpr double kMaxPixels = 40e6;
constexpr double kWorthwhile = 1.05;     // reductions below this blur more than they save
constexpr double kMinPixelsPerEdge = 8;  // below it regions get too few pixels to be told apart

int working_side(int side, double edge) {
  double factor = edge / kPixelsPerEdge;
  if (edge < kMinPixelsPerEdge) {
    factor = edge / kMinPixelsPerEdge;
  } else if (factor < kWorthwhile) {
    return side;
  }
  return std::max(1, static_cast<int>(std::lround(side / factor)));
}

}  // namespace

WorkingPicture make_working_picture(const Raster& picture, double edge) {
  double w = working_side(picture.width, edge), h = working_side(picture.height, edge);
  const double excess = w * h / kMaxPixels;
  if (excess > 1) {
    w = std::max(1.0, std::floor(w / std::sqrt(excess)));
    h = std::max(1.0, std::floor(h / std::sqrt(excess)));
  }
  WorkingPicture working;
  working.scale_x = picture.width / w;
  working.scale_y = picture.height / h;
  const auto to_size = [&](const Raster& source) {
    if (w == source.width && h == source.height) return source;
    return resized(source, static_cast<int>(w), static_cast<int>(h));
  };
  working.picture = to_size(picture.has_alpha() ? premultiplied(picture) : picture);
  return working;
}

}  // namespace quadrille
