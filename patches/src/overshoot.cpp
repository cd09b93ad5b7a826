#include "overshoot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit_element.h"
#include "parallel_ranges.h"
#include "picture_sampling.h"
#include "quadrille/patch_geometry.h"

namespace quadrille {
namespace {

constexpr double kReach = 1;     // pixels around a patch that may show its colours
constexpr int kPlacesAlong = 5;  // of either parameter
constexpr double kRounding = 1e-6;

Eigen::Vector2d parameters_of(int number) {
  return Eigen::Vector2d(number % kPlacesAlong, number / kPlacesAlong) / (kPlacesAlong - 1);
}

struct ColorRange {
  Eigen::Array4d least = Eigen::Array4d::Constant(INFINITY);
  Eigen::Array4d most = Eigen::Array4d::Constant(-INFINITY);
};

bool is_within(const ColorRange& range, const Eigen::Array4d& color) {
  return (color >= range.least).all() && (color <= range.most).all();
}

ColorRange colors_around(const std::array<Eigen::Vector2d, 4>& corners, const Raster& picture) {
  Eigen::Array2d low = corners[0], high = low;
  for (const Eigen::Vector2d& p : corners) low = low.min(p.array()), high = high.max(p.array());
  const auto index = [](double at, int size) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
  };
  ColorRange range;
  for (int y = index(low.y() - kReach, picture.height);
       y < index(std::ceil(high.y() + kReach), picture.height); ++y) {
    for (int x = index(low.x() - kReach, picture.width);
         x < index(std::ceil(high.x() + kReach), picture.width); ++x) {
      const Eigen::Array4d color = premultiplied_pixel(picture, x, y).cast<double>();
      range.least = range.least.min(color);
      range.most = range.most.max(color);
    }
  }
  return range;
}

}  // namespace

void Overshoot::find_in_patch(const PatchMesh& patches, int q, const Raster& picture,
                              double allowed, std::vector<Place>& places) {
  const FergusonPatch patch = ferguson_patch(patches, q);
  ColorRange range = colors_around(patch.position.value, picture);
  range.least -= allowed + kRounding;
  range.most += allowed + kRounding;
  for (int number = 0; number < kPlacesAlong * kPlacesAlong; ++number) {
    const Eigen::Vector2d uv = parameters_of(number);
    const Eigen::Array4d color = patch.color.at(uv.x(), uv.y()).cast<double>();
    if (is_within(range, color) || (is_found_[q] >> number & 1)) continue;
    // Beyond the outermost pixel centres the picture goes on as a line.
    const Eigen::Array4d here = sample_bilinear(picture, patch.position.at(uv.x(), uv.y()));
    const ColorRange wider = {range.least.min(here - allowed), range.most.max(here + allowed)};
    if (is_within(wider, color)) continue;
    places.push_back({q, number, wider.least, wider.most});
    is_found_[q] |= std::uint32_t{1} << number;
  }
}

bool Overshoot::find(const PatchMesh& patches, const Raster& picture, double allowed) {
  static_assert(kPlacesAlong * kPlacesAlong <= 32);
  is_found_.resize(patches.patch_count());
  const std::size_t before = places_.size();
  std::vector<std::vector<Place>> found((patches.patch_count() + kRangeSize - 1) / kRangeSize);
  for_each_range(patches.patch_count(), [&](int begin, int end) {
    for (int q = begin; q < end; ++q) {
      find_in_patch(patches, q, picture, allowed, found[begin / kRangeSize]);
    }
  });
  for (const auto& part : found) places_.insert(places_.end(), part.begin(), part.end());
  return places_.size() > before;
}

void Overshoot::add_equations(const PatchMesh& patches, WedgeRows& rows) const {
  for (const Place& place : places_) {
    const int q = place.patch;
    const Eigen::Vector2d uv = parameters_of(place.number);
    const auto factors = corner_factors(corner_maps(patches, q), uv);
    std::array<WedgeRows::Entry, 4> entries;
    for (int k = 0; k < 4; ++k) {
      entries[k] = {patches.wedge_of_corner[4 * q + k], factors[k]};
    }
    std::ranges::sort(entries, {}, &WedgeRows::Entry::wedge);
    const Eigen::Array4d shown = ferguson_patch(patches, q).color.at(uv.x(), uv.y()).cast<double>();
    rows.add(entries, patches, shown.max(place.least).min(place.most));
  }
}

}  // namespace quadrille
