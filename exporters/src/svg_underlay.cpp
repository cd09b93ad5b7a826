#include "svg_underlay.h"

#include <algorithm>

#include "svg_clip.h"

namespace quadrille {
namespace {

/// Patches of a group: more save bytes, fewer are nearer to the patches' own colours.
constexpr std::size_t kGroupSize = 24;

class Grouper {
 public:
  Grouper(const SvgLayer& layer, double width, double height)
      : layer_(layer),
        mesh_(layer.mesh()),
        size_(width, height),
        group_(mesh_.quad_count(), kNone),
        seen_(mesh_.halfedge_count(), 0) {
    for (const int q : layer.quads(PatchOpacity::opaque)) {
      if (!touches_outline(q)) group_[q] = kOpen;
    }
  }

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

  /// The straight border of the picture does not count: it lies on the border of pixels.
  bool touches_outline(int q) const {
    for (int k = 0; k < 4; ++k) {
      const int h = 4 * q + k, twin = mesh_.twin(h);
      const bool ends =
          twin < 0 ? !on_picture_border(h) : !layer_.is_opaque(QuadMesh::quad_of(twin));
      if (ends) return true;
    }
    return false;
  }

  bool on_picture_border(int h) const {
    return is_on_a_side(edge_curve(layer_.layer(), h), size_.x(), size_.y());
  }

  /// All of them without a seam, below the groups.
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
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (const int q : quads) sum += layer_.color(q).at(0.5, 0.5).head<3>().cast<double>();
    return (255 * sum / std::max(1.0, double(quads.size()))).max(0.0).min(255.0);
  }

  const SvgLayer& layer_;
  const QuadMesh& mesh_;
  Eigen::Vector2d size_;
  std::vector<int> group_;
  std::vector<char> seen_;
};

}  // namespace

std::vector<UnderlayGroup> underlay_groups(const SvgLayer& layer, double width, double height) {
  return Grouper(layer, width, height).run();
}

}  // namespace quadrille
