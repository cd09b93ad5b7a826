#include "svg_underlay.h"

#include <algorithm>

#include "svg_clip.h"

namespace quadrille {
namespace {

/// Patches of a group: more save bytes, fewer are nearer to the patches' own colours.
constexpr std::size_t kGroupSize = 24;

class Grouper {
 public:
  /// Of the quads that are marked.
  Grouper(const SvgLayer& layer, const std::vector<char>& marked)
      : layer_(layer),
        mesh_(layer.mesh()),
        group_(mesh_.quad_count(), kNone),
        seen_(mesh_.halfedge_count(), 0) {
    for (int q = 0; q < mesh_.quad_count(); ++q) {
      if (marked[q]) group_[q] = kOpen;
    }
  }

  /// All of them without a seam, in their mean colour.
  UnderlayGroup whole() const {
    std::vector<char> inside(mesh_.quad_count());
    std::vector<int> quads;
    for (int q = 0; q < mesh_.quad_count(); ++q) {
      inside[q] = group_[q] == kOpen;
      if (inside[q]) quads.push_back(q);
    }
    UnderlayGroup group;
    group.color = mean_color(quads);
    for (const EdgeLoop& loop : border_of(mesh_, inside)) {
      SvgOutline& outline = group.outlines.emplace_back();
      outline.start = corner(loop.front());
      for (const int h : loop) {
        const Eigen::Vector2d p = corner(QuadMesh::next(h));
        outline.pieces.push_back({true, p, p, p});
      }
    }
    return group;
  }

  /// All of them, and above that some after some.
  std::vector<UnderlayGroup> run() {
    std::vector<UnderlayGroup> groups = {whole()};
    for (int q = 0; q < mesh_.quad_count(); ++q) {
      if (group_[q] != kOpen) continue;
      const std::vector<int> quads = gather(q, static_cast<int>(groups.size()));
      groups.push_back({outlines(quads), mean_color(quads)});
    }
    return groups;
  }

 private:
  static constexpr int kNone = -1, kOpen = -2;

  /// The half-edge on the other side of h where that may be in the same group, or -1.
  int neighbor(int h) const { return mesh_.is_tear(mesh_.edge(h)) ? -1 : mesh_.twin(h); }

  std::vector<int> gather(int first, int id) {
    std::vector<int> quads{first};
    group_[first] = id;
    for (std::size_t i = 0; i < quads.size(); ++i) {
      for (int k = 0; k < 4 && quads.size() < kGroupSize; ++k) {
        const int h = neighbor(4 * quads[i] + k);
        if (h < 0 || group_[QuadMesh::quad_of(h)] != kOpen) continue;
        group_[QuadMesh::quad_of(h)] = id;
        quads.push_back(QuadMesh::quad_of(h));
      }
    }
    return quads;
  }

  bool is_inside(int h) const {
    const int across = neighbor(h);
    return across >= 0 && group_[QuadMesh::quad_of(across)] == group_[QuadMesh::quad_of(h)];
  }

  std::vector<SvgOutline> outlines(const std::vector<int>& quads) {
    std::vector<SvgOutline> loops;
    for (const int q : quads) {
      for (int h = 4 * q; h < 4 * q + 4; ++h) {
        if (!seen_[h] && !is_inside(h)) loops.push_back(loop(h));
      }
    }
    return loops;
  }

  SvgOutline loop(int first) {
    SvgOutline outline;
    outline.start = corner(first);
    int h = first;
    do {
      seen_[h] = 1;
      h = QuadMesh::next(h);
      while (is_inside(h)) h = QuadMesh::next(mesh_.twin(h));
      const Eigen::Vector2d p = corner(h);
      outline.pieces.push_back({true, p, p, p});
    } while (h != first && !seen_[h]);
    return outline;
  }

  Eigen::Vector2d corner(int h) const {
    return layer_.geometry(QuadMesh::quad_of(h)).value[QuadMesh::corner_of(h)];
  }

  Eigen::Array3d mean_color(const std::vector<int>& quads) const {
    Color sum = Color::Zero();
    for (const int q : quads) sum += layer_.color(q).at(0.5, 0.5);
    const double straight = 255 / std::max(double(sum[3]), 1e-3);
    return (straight * sum.head<3>().cast<double>()).max(0.0).min(255.0);
  }

  const SvgLayer& layer_;
  const QuadMesh& mesh_;
  std::vector<int> group_;
  std::vector<char> seen_;
};

/// True when the patch borders on one of an opacity that `ends` it, or on nothing. The straight
/// border of the picture does not count: it lies on the border of pixels.
template <class Ends>
bool touches_end(const SvgLayer& layer, int q, double width, double height, const Ends& ends) {
  for (int h = 4 * q; h < 4 * q + 4; ++h) {
    const int twin = layer.mesh().twin(h);
    if (twin < 0 ? !is_on_a_side(edge_curve(layer.layer(), h), width, height)
                 : ends(layer.opacity(QuadMesh::quad_of(twin)))) {
      return true;
    }
  }
  return false;
}

bool is_nearly_opaque(const SvgLayer& layer, int q) {
  constexpr float kLeastAlpha = 0.9f;
  const auto& corners = layer.color(q).value;
  return std::all_of(corners.begin(), corners.end(),
                     [](const Color& color) { return color[3] >= kLeastAlpha; });
}

/// The opaque patches that have a vertex in common with translucent ones.
std::vector<char> opaque_beside_translucent(const SvgLayer& layer) {
  const QuadMesh& mesh = layer.mesh();
  std::vector<char> touched(mesh.vertex_count(), 0), beside(mesh.quad_count(), 0);
  for (const int q : layer.quads(PatchOpacity::translucent)) {
    for (const int v : mesh.quads()[q]) touched[v] = 1;
  }
  for (const int q : layer.quads(PatchOpacity::opaque)) {
    for (const int v : mesh.quads()[q]) beside[q] |= touched[v];
  }
  return beside;
}

}  // namespace

std::vector<UnderlayGroup> opaque_underlay(const SvgLayer& layer, double width, double height) {
  std::vector<char> marked(layer.mesh().quad_count(), 0);
  const auto ends = [](PatchOpacity opacity) { return opacity != PatchOpacity::opaque; };
  for (const int q : layer.quads(PatchOpacity::opaque)) {
    marked[q] = !touches_end(layer, q, width, height, ends);
  }
  return Grouper(layer, marked).run();
}

std::vector<UnderlayGroup> translucent_underlay(const SvgLayer& layer) {
  std::vector<char> marked = opaque_beside_translucent(layer);
  for (const int q : layer.quads(PatchOpacity::translucent)) marked[q] = 1;
  return Grouper(layer, marked).run();
}

UnderlayGroup mask_underlay(const SvgLayer& layer, double width, double height) {
  std::vector<char> marked = opaque_beside_translucent(layer);
  for (const int q : layer.quads(PatchOpacity::translucent)) marked[q] = is_nearly_opaque(layer, q);
  const auto ends = [](PatchOpacity opacity) { return opacity == PatchOpacity::transparent; };
  for (int q = 0; q < layer.mesh().quad_count(); ++q) {
    if (marked[q]) marked[q] = !touches_end(layer, q, width, height, ends);
  }
  UnderlayGroup group = Grouper(layer, marked).whole();
  group.color.fill(255);
  return group;
}

}  // namespace quadrille
