#include "sheeted_layer.h"

#include <algorithm>
#include <string>

#include "paintable_patch.h"
#include "patch_opacity.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

constexpr double kInvisible = 0.5 / 255;  // alpha

}  // namespace

SheetedLayer::SheetedLayer(const Layer& layer, Unpaintable unpaintable) : layer_(layer) {
  find_patches(unpaintable);
  color_sheets();
  widen_sheets();
  join_corners();
}

void SheetedLayer::find_patches(Unpaintable unpaintable) {
  const int count = mesh().quad_count();
  position_.reserve(count);
  color_.reserve(count);
  for (int q = 0; q < count; ++q) {
    position_.push_back(to_bezier(placed_geometry(layer_, q)));
    color_.push_back(bezier_patch(layer_.patches, q).color);
    paintable_.push_back(is_paintable(position_[q], color_[q]));
    if (paintable_[q] || unpaintable == Unpaintable::hide) continue;
    throw Error(ErrorCode::invalid_argument,
                "patch " + std::to_string(q) + " of layer '" + layer_.name +
                    "' is not finite or reaches farther than 10 million pixels; remove it or scale "
                    "the layer down");
  }
}

std::vector<int> SheetedLayer::torn_from(int quad) const {
  std::vector<int> others;
  for (int h = 4 * quad; h < 4 * quad + 4; ++h) {
    for (const int other : mesh().fan(mesh().origin(h))) {
      const auto& wedge = layer_.patches.wedge_of_corner;
      if (wedge[other] != wedge[h]) others.push_back(QuadMesh::quad_of(other));
    }
  }
  return others;
}

/// Greedy colouring in the order of a breadth-first search over the patches that tears separate:
/// along a tear that meets no other, one side is on the first sheet and the other on the second.
void SheetedLayer::color_sheets() {
  constexpr int kOpen = -2, kHidden = -1;
  sheet_.assign(mesh().quad_count(), kOpen);
  for (const int q : patches_with(paint_opacities(layer_.patches, kInvisible, paintable_),
                                  PatchOpacity::transparent)) {
    sheet_[q] = kHidden;
  }
  std::vector<int> queue;
  std::vector<char> is_queued(mesh().quad_count(), 0);
  for (int first = 0; first < mesh().quad_count(); ++first) {
    if (sheet_[first] != kOpen) continue;
    queue.assign(1, first);
    is_queued[first] = 1;
    for (std::size_t at = 0; at < queue.size(); ++at) {
      std::vector<int> taken;
      for (const int other : torn_from(queue[at])) {
        taken.push_back(sheet_[other]);
        if (sheet_[other] == kOpen && !is_queued[other]) queue.push_back(other);
        is_queued[other] = 1;
      }
      int sheet = 0;
      while (std::find(taken.begin(), taken.end(), sheet) != taken.end()) ++sheet;
      sheet_[queue[at]] = sheet;
      sheet_count_ = std::max(sheet_count_, sheet + 1);
    }
  }
}

/// What lies behind a side of a tear goes on its sheet, too, so that the two sides' paint is some
/// patches apart on each sheet: filtering over a few texels then mixes nothing.
void SheetedLayer::widen_sheets() {
  constexpr int kRings = 2;
  std::vector<int> ring;
  std::vector<char> is_reached(mesh().quad_count(), 0);
  for (int q = 0; q < mesh().quad_count(); ++q) {
    if (torn_from(q).empty()) continue;
    is_reached[q] = 1;
    if (is_drawn(q)) ring.push_back(q);
  }
  for (int k = 0; k < kRings; ++k) {
    std::vector<int> next;
    for (const int q : ring) {
      for (int h = 4 * q; h < 4 * q + 4; ++h) {
        const int twin = mesh().twin(h);
        const int other = twin < 0 ? q : QuadMesh::quad_of(twin);
        if (is_reached[other] || !is_drawn(other)) continue;
        is_reached[other] = 1;
        sheet_[other] = sheet_[q];
        next.push_back(other);
      }
    }
    ring = std::move(next);
  }
}

std::vector<char> SheetedLayer::torn_off(int sheet) const {
  std::vector<char> is_torn_off(mesh().quad_count(), 0);
  for (int q = 0; q < mesh().quad_count(); ++q) {
    if (sheet_[q] != sheet) continue;
    for (const int other : torn_from(q)) is_torn_off[other] = sheet_[other] != sheet;
  }
  return is_torn_off;
}

void SheetedLayer::join_corners() {
  const auto& wedge = layer_.patches.wedge_of_corner;
  shared_corner_.assign(mesh().halfedge_count(), 0);
  for (int h = 0; h < mesh().halfedge_count(); ++h) {
    int lowest = h;
    for (const int other : mesh().fan(mesh().origin(h))) {
      const bool is_same = wedge[other] == wedge[h] &&
                           sheet(QuadMesh::quad_of(other)) == sheet(QuadMesh::quad_of(h));
      if (is_same) lowest = std::min(lowest, other);
    }
    shared_corner_[h] = lowest;
  }
}

int SheetedLayer::shared_side(int h) const {
  const int twin = mesh().twin(h);
  const bool is_shared = twin >= 0 && shared_corner(h) == shared_corner(QuadMesh::next(twin)) &&
                         shared_corner(QuadMesh::next(h)) == shared_corner(twin);
  return is_shared ? std::min(h, twin) : h;
}

std::vector<int> SheetedLayer::colors_at(int h) const {
  const auto& wedge = layer_.patches.wedge_of_corner;
  std::vector<int> corners;
  for (const int other : mesh().fan(mesh().origin(h))) {
    if (is_drawn(QuadMesh::quad_of(other))) corners.push_back(other);
  }
  std::sort(corners.begin(), corners.end());
  std::vector<int> found;
  for (const int corner : corners) {
    const bool is_new = std::none_of(found.begin(), found.end(),
                                     [&](int one) { return wedge[one] == wedge[corner]; });
    if (is_new) found.push_back(corner);
  }
  return found;
}

bool SheetedLayer::is_contour(int h) const {
  const int twin = mesh().twin(h);
  return twin < 0 || shared_side(h) != shared_side(twin);
}

PlaneCurve SheetedLayer::edge_curve(int e) const {
  const int h = mesh().halfedge(e);
  return side_curve(position(QuadMesh::quad_of(h)), QuadMesh::corner_of(h));
}

}  // namespace quadrille
