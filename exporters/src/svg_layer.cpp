#include "svg_layer.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "paintable_patch.h"
#include "quadrille/mesh_region.h"
#include "subdivision.h"
#include "svg_clip.h"
#include "svg_tiles.h"

namespace quadrille {
namespace {

/// With more regions than this all count as one: each takes a pass over the mesh.
constexpr int kMostRegions = 64;
/// A translucent patch is faint when its alpha is below this at its corners.
constexpr float kFaint = 0.25f;
/// The most patches of a tile, all of which are worked on together: bounds the memory.
constexpr int kTileSize = 512;

}  // namespace

SvgLayer::SvgLayer(const Layer& layer, double tolerance, double width, double height)
    : layer_(layer),
      paintable_(paintable_patches(layer)),
      opacity_(paint_opacities(layer.patches, tolerance, paintable_)),
      region_(smooth_regions(layer.patches.mesh)) {
  const bool too_many = std::ranges::any_of(region_, [](int r) { return r >= kMostRegions; });
  if (too_many) std::ranges::fill(region_, 0);
  faint_.assign(mesh().quad_count(), 0);
  for (const int q : patches_with(opacity_, PatchOpacity::translucent)) {
    const auto corners = color(q).value;
    faint_[q] = std::ranges::all_of(corners, [](const Color& c) { return c[3] < kFaint; });
  }
  number_parts(width, height);
  number_tiles();
}

void SvgLayer::number_parts(double width, double height) {
  std::vector<char> painted(mesh().quad_count());
  for (int q = 0; q < mesh().quad_count(); ++q) painted[q] = is_opaque(q);
  parts_ = paint_groups(mesh(), painted, paintable_);
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

void SvgLayer::number_tiles() {
  tile_.assign(mesh().quad_count(), 0);
  std::vector<Eigen::Vector2d> corners(mesh().quad_count());
  for (int q = 0; q < mesh().quad_count(); ++q) corners[q] = mesh().vertices[mesh().quads()[q][0]];
  std::map<std::tuple<bool, bool, int>, std::vector<int>> sets;
  for (int q = 0; q < mesh().quad_count(); ++q) {
    if (opacity_[q] == PatchOpacity::transparent) continue;
    sets[{is_opaque(q), !faint_[q], is_opaque(q) ? part(q) : region_[q]}].push_back(q);
  }
  int count = 0;
  for (auto& [key, quads] : sets) {
    for (const auto& tile : divide_into_tiles(std::move(quads), corners, kTileSize)) {
      for (const int q : tile) tile_[q] = count;
      ++count;
    }
  }
}

std::vector<int> SvgLayer::quads(PatchOpacity opacity) const {
  std::vector<int> list = patches_with(opacity_, opacity);
  std::stable_sort(list.begin(), list.end(), [&](int a, int b) { return tile_[a] < tile_[b]; });
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
  return std::pair(tile_[other], other) > std::pair(tile_[quad], quad);
}

}  // namespace quadrille
