#include "region_features.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "contour.h"
#include "inside_test.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kArm = 2, kLeastArm = 1.5;  // of the direction; working and source pixels
constexpr double kSharpTurn = 50 * std::numbers::pi / 180;

void clear_outside(FeatureTensor& features, const std::vector<Loop>& outline,
                   const WorkingPicture& working) {
  const InsideTest inside(outline);
  for (int y = 0; y < features.weight.height; ++y) {
    for (int x = 0; x < features.weight.width; ++x) {
      if (inside({(x + 0.5) * working.scale_x, (y + 0.5) * working.scale_y})) continue;
      features.direction(x, y) = 0;
      features.weight(x, y) = 0;
      features.gradient(x, y).setZero();
      features.edges(x, y) = 0;
    }
  }
}

}  // namespace

void confine_features(FeatureTensor& features, const std::vector<Loop>& outline,
                      const WorkingPicture& working) {
  clear_outside(features, outline, working);
  const int w = features.weight.width, h = features.weight.height;
  const double scale = std::min(working.scale_x, working.scale_y);
  const double arm = std::max(kArm * scale, kLeastArm);
  struct Nearest {
    double distance;
    OutlinePixel pixel;
  };
  std::map<int, Nearest> found;  // by pixel index
  for (const Loop& loop : outline) {
    const Contour contour(loop);
    const int steps = static_cast<int>(std::ceil(2 * contour.length() / scale));
    for (int k = 0; k < steps; ++k) {
      const double s = contour.length() * k / steps;
      if (contour.turning(s, arm) > kSharpTurn) continue;
      const Vector2d source = contour.smooth_at(s);
      const Vector2d p(source.x() / working.scale_x, source.y() / working.scale_y);
      const int x = std::clamp(static_cast<int>(p.x()), 0, w - 1);
      const int y = std::clamp(static_cast<int>(p.y()), 0, h - 1);
      const double distance = (p - Vector2d(x + 0.5, y + 0.5)).norm();
      const auto [it, is_new] = found.try_emplace(y * w + x, Nearest{distance, {}});
      if (!is_new && distance >= it->second.distance) continue;
      const Vector2d direction = contour.direction(s, arm);
      const Vector2d along(direction.x() / working.scale_x, direction.y() / working.scale_y);
      it->second = {
          distance,
          {x, y, p.cast<float>(), Vector2d(-along.y(), along.x()).normalized().cast<float>()}};
    }
  }
  for (const auto& [index, nearest] : found) {
    features.outline.push_back(nearest.pixel);
    features.direction.data[index] = nearest.pixel.cross();
    features.weight.data[index] = 1;
    features.edges.data[index] = 1;
  }
}

}  // namespace quadrille
