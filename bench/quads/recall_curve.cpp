#include "recall_curve.h"

#include <algorithm>
#include <array>

#include "slic.h"

namespace quadrille::bench {
namespace {

constexpr std::array kSlicSizes = {64, 48, 40, 33, 28, 24, 20, 17, 14, 12, 11, 10, 9, 8, 7, 6, 5};

RecallPoint blend(const RecallPoint& a, const RecallPoint& b, double t) {
  const auto mix = [t](double from, double to) { return from + t * (to - from); };
  return {mix(a.cells, b.cells),
          {mix(a.score.recall, b.score.recall), mix(a.score.density, b.score.density)}};
}

/// The point at which the figure that grows along the curve reaches `value`.
template <class Figure>
RecallPoint reach(const std::vector<RecallPoint>& points, double value, const Figure& figure) {
  const auto above = std::ranges::find_if(
      points, [&](const RecallPoint& point) { return figure(point) >= value; });
  if (above == points.begin()) return points.front();
  if (above == points.end()) return points.back();
  const RecallPoint& below = *(above - 1);
  return blend(below, *above, (value - figure(below)) / (figure(*above) - figure(below)));
}

}  // namespace

RecallPoint RecallCurve::at_cells(double cells) const {
  return reach(points_, cells, [](const RecallPoint& point) { return point.cells; });
}

RecallPoint RecallCurve::at_density(double density) const {
  return reach(points_, density, [](const RecallPoint& point) { return point.score.density; });
}

std::vector<RecallPoint> slic_points(const Raster& picture,
                                     const std::vector<BoundaryMask>& annotations, float ruler) {
  std::vector<RecallPoint> points;
  for (const int size : kSlicSizes) {
    const auto segmentation = slic(picture, {size, ruler});
    if (!segmentation) return {};
    points.push_back({static_cast<double>(segmentation->cells),
                      boundary_score(boundary_of(segmentation->labels), annotations)});
  }
  return points;
}

}  // namespace quadrille::bench
