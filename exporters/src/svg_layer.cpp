#include "svg_layer.h"

#include <algorithm>
#include <map>
#include <utility>

#include "quadrille/mesh_region.h"
#include "subdivision.h"
#include "svg_clip.h"

namespace quadrille {
namespace {

/// With more regions than this all count as one: each takes a pass over the mesh.
constexpr int kMostRegions = 64;

}  // namespace

SvgLayer::SvgLayer(const Layer& layer, double tolerance, double width, double height)
    : layer_(layer),
      opacity_(paint_opacities(layer, tolerance)),
      region_(smooth_regions(layer.patches.mesh)) {
  const bool too_many = std::ranges::any_of(region_, [](int r) { return r >= kMostRegions; });
  if (too_many) std::ranges::fill(region_, 0);
  number_parts(width, height);
}

void SvgLayer::number_parts(double width, double height) {
  std::vector<char> painted(mesh().quad_count());
  for (int q = 0; q < mesh().quad_count(); ++q) painted[q] = is_opaque(q);
  parts_ = paint_groups(mesh(), painted);
  parts_.open_border = fills_picture(layer_, width, height);
  std::map<std::pair<int, int>, int> numbers;
  for (int q = 0; q < mesh().quad_count(); ++q) {
    if (painted[q]) numbers.try_emplace({region_[q], parts_.group[q]}, 0);
  }
  parts_.count = 0;
  for (auto& [part, number] : numbers) number = parts_.count++;
  for (int q = 0; q < mesh().quad_count(); ++q) {
    if (painted[q]) parts_.group[q] = numbers.at({region_[q], parts_.group[q]});
  }
}

std::vector<int> SvgLayer::quads(PatchOpacity opacity) const {
  std::vector<int> list = patches_with(opacity_, opacity);
  const bool in_parts = opacity == PatchOpacity::opaque;
  const std::vector<int>& number = in_parts ? parts_.group : region_;
  std::stable_sort(list.begin(), list.end(), [&](int a, int b) { return number[a] < number[b]; });
  return list;
}

BicubicHermite<Eigen::Vector2d> SvgLayer::geometry(int quad) const {
  return placed_geometry(layer_, quad);
}

BicubicHermite<Color> SvgLayer::color(int quad) const {
  return ferguson_patch(layer_.patches, quad).color;
}

bool SvgLayer::is_painted_later(int h) const {
  const int twin = mesh().twin(h);
  return twin >= 0 && is_painted_later(QuadMesh::quad_of(h), QuadMesh::quad_of(twin));
}

bool SvgLayer::is_painted_later(int quad, int other) const {
  const PatchOpacity mine = opacity_[quad], its = opacity_[other];
  if (its == PatchOpacity::transparent) return false;
  if (mine != its) return its == PatchOpacity::opaque;
  const std::vector<int>& number = its == PatchOpacity::opaque ? parts_.group : region_;
  return std::pair(number[other], other) > std::pair(number[quad], quad);
}

}  // namespace quadrille
