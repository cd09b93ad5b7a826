#include "vtk_points.h"

#include "quadrille/patch_mesh.h"

namespace quadrille {
namespace {

/// Row j (along v) and column i (along u) of a control point.
struct ControlIndex {
  int j, i;
};

/// VTK's order in its own parameters (r, s): corners; inner points of the edges s = 0, r = 1,
/// s = 1, r = 0, each along the growing parameter; the inside row by row.
constexpr int kVtkOrder[16][2] = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 0}, {2, 0}, {3, 1}, {3, 2},
                                  {1, 3}, {2, 3}, {0, 1}, {0, 2}, {1, 1}, {2, 1}, {1, 2}, {2, 2}};

/// Per corner k: the corner's control point, and those of half-edge 4 q + k next to its origin and
/// next to its tip.
constexpr ControlIndex kCorner[4] = {{0, 0}, {0, 3}, {3, 3}, {3, 0}};
constexpr ControlIndex kNearOrigin[4] = {{0, 1}, {1, 3}, {3, 2}, {2, 0}};
constexpr ControlIndex kNearTip[4] = {{0, 2}, {2, 3}, {3, 1}, {1, 0}};

class PointNumbering {
 public:
  explicit PointNumbering(const PatchMesh& patches)
      : patches_(patches),
        corner_(patches.wedges.size(), -1),
        near_origin_(patches.mesh.halfedge_count(), -1),
        near_tip_(patches.mesh.halfedge_count(), -1) {}

  using Net = std::array<std::array<int, 4>, 4>;

  /// The points of patch q by row and column; patches are to be numbered in ascending order.
  Net number(int q) {
    Net net;
    for (int k = 0; k < 4; ++k) {
      const int h = 4 * q + k;
      at(net, kCorner[k]) = once(corner_[patches_.wedge_of_corner[h]]);
      at(net, kNearOrigin[k]) = once(near_origin_[h], near_tip_, same_wedge_at_origin(h));
      at(net, kNearTip[k]) = once(near_tip_[h], near_origin_, same_wedge_at_tip(h));
    }
    for (int j = 1; j < 3; ++j) {
      for (int i = 1; i < 3; ++i) net[j][i] = count_++;
    }
    return net;
  }

  int count() const { return count_; }

 private:
  static int& at(Net& net, ControlIndex c) { return net[c.j][c.i]; }

  int once(int& id) {
    if (id < 0) id = count_++;
    return id;
  }
  /// Takes the number that the neighbour's half-edge already has for the same point, if it may.
  int once(int& id, const std::vector<int>& of_twin, int twin) {
    if (twin >= 0 && of_twin[twin] >= 0) id = of_twin[twin];
    return once(id);
  }

  /// The twin of h when both sides see the same colours at h's origin, else -1.
  int same_wedge_at_origin(int h) const {
    const int t = patches_.mesh.twin(h);
    return t >= 0 && wedge(h) == wedge(QuadMesh::next(t)) ? t : -1;
  }
  int same_wedge_at_tip(int h) const {
    const int t = patches_.mesh.twin(h);
    return t >= 0 && wedge(QuadMesh::next(h)) == wedge(t) ? t : -1;
  }
  int wedge(int corner) const { return patches_.wedge_of_corner[corner]; }

  const PatchMesh& patches_;
  std::vector<int> corner_;                  // per wedge
  std::vector<int> near_origin_, near_tip_;  // per half-edge
  int count_ = 0;
};

}  // namespace

ControlPoints control_points(const Layer& layer, double picture_height) {
  const PatchMesh& patches = layer.patches;
  const bool mirrored = layer.transform.linear().determinant() < 0;
  ControlPoints points;
  points.cells.reserve(patches.patch_count());
  PointNumbering numbering(patches);
  for (int q = 0; q < patches.patch_count(); ++q) {
    const BezierPatch patch = bezier_patch(patches, q);
    const PointNumbering::Net net = numbering.number(q);
    points.position.resize(numbering.count());
    points.color.resize(numbering.count());
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        const Eigen::Vector2d p = layer.transform * patch.position.control[j][i];
        points.position[net[j][i]] = {p.x(), picture_height - p.y()};
        points.color[net[j][i]] = patch.color.control[j][i];
      }
    }
    std::array<int, 16>& cell = points.cells.emplace_back();
    for (int k = 0; k < 16; ++k) {
      const auto [r, s] = kVtkOrder[k];
      cell[k] = mirrored ? net[s][r] : net[r][s];
    }
  }
  return points;
}

}  // namespace quadrille
