#include "svg_tiles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace quadrille {
namespace {

using Iterator = std::vector<int>::iterator;

void divide(Iterator begin, Iterator end, const std::vector<Eigen::Vector2d>& points, int most,
            std::vector<std::vector<int>>& tiles) {
  if (end - begin <= most) {
    std::sort(begin, end);
    tiles.emplace_back(begin, end);
    return;
  }
  Eigen::AlignedBox2d box;
  for (auto it = begin; it != end; ++it) box.extend(points[*it]);
  const int axis = box.sizes().x() >= box.sizes().y() ? 0 : 1;
  const auto middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](int a, int b) {
    return std::pair(points[a][axis], a) < std::pair(points[b][axis], b);
  });
  divide(begin, middle, points, most, tiles);
  divide(middle, end, points, most, tiles);
}

}  // namespace

std::vector<std::vector<int>> divide_into_tiles(std::vector<int> numbers,
                                                const std::vector<Eigen::Vector2d>& points,
                                                int most) {
  std::vector<std::vector<int>> tiles;
  if (!numbers.empty()) divide(numbers.begin(), numbers.end(), points, most, tiles);
  return tiles;
}

}  // namespace quadrille
