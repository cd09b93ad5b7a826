#include <algorithm>
#include <array>
#include <vector>

#include "quadrille/patch_geometry.h"
#include "quadrille/remove_duplicates.h"

namespace quadrille {
namespace {

/// Coefficients of a scalar Bezier form of degree 5 in u (columns) and in v (rows).
using Quintic = std::array<std::array<double, 6>, 6>;
using Control = std::array<std::array<Eigen::Vector2d, 4>, 4>;

constexpr std::array<double, 3> kChoose2 = {1, 2, 1};
constexpr std::array<double, 4> kChoose3 = {1, 3, 3, 1};
constexpr std::array<double, 6> kChoose5 = {1, 5, 10, 10, 5, 1};

struct Jacobian {
  Quintic coefficients;
  double rounding;  ///< bounds what rounding may have added to a coefficient
};

/// det(P_u, P_v) / 9: the product of two Bezier forms, each coefficient the binomially weighted sum
/// of the products that fall on it (Farin, Curves and Surfaces for CAGD, section 6.10).
Jacobian jacobian(const BicubicHermite<Eigen::Vector2d>& geometry) {
  BicubicHermite<Eigen::Vector2d> local = geometry;
  for (auto& p : local.value) p -= geometry.value[0];
  const Control b = to_bezier(local).control;

  std::array<std::array<Eigen::Vector2d, 3>, 4> du;  // [v][u], degrees (2, 3)
  std::array<std::array<Eigen::Vector2d, 4>, 3> dv;  // [v][u], degrees (3, 2)
  double longest_u = 0, longest_v = 0;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d u = b[j][i + 1] - b[j][i], v = b[i + 1][j] - b[i][j];
      longest_u = std::max(longest_u, u.norm());
      longest_v = std::max(longest_v, v.norm());
      du[j][i] = u * (kChoose3[j] * kChoose2[i]);
      dv[i][j] = v * (kChoose2[i] * kChoose3[j]);
    }
  }
  Quintic sum{};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 3; ++i) {
      for (int l = 0; l < 3; ++l) {
        for (int k = 0; k < 4; ++k) {
          sum[j + l][i + k] += du[j][i].x() * dv[l][k].y() - du[j][i].y() * dv[l][k].x();
        }
      }
    }
  }
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) sum[j][i] /= kChoose5[j] * kChoose5[i];
  }
  return {sum, 1e-13 * longest_u * longest_v};
}

/// Halves at 1/2 along the first index.
std::array<Quintic, 2> halves(const Quintic& whole) {
  std::array<Quintic, 2> half;
  half[1] = whole;
  Quintic& row = half[1];
  for (int level = 0; level < 6; ++level) {
    half[0][level] = row[0];
    for (int j = 0; j + level < 5; ++j) {
      for (int i = 0; i < 6; ++i) row[j][i] = 0.5 * (row[j][i] + row[j + 1][i]);
    }
  }
  return half;
}

Quintic transposed(const Quintic& q) {
  Quintic t;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) t[i][j] = q[j][i];
  }
  return t;
}

/// True when the polynomial is proved to exceed `bound` on the whole square.
bool certify_above(double bound, const Quintic& q, int depth) {
  // The corner coefficients are values of the polynomial, so a single one can refute it.
  for (const int j : {0, 5}) {
    for (const int i : {0, 5}) {
      if (!(q[j][i] > bound)) return false;
    }
  }
  const bool all_above = std::all_of(q.begin(), q.end(), [&](const auto& row) {
    return std::all_of(row.begin(), row.end(), [&](double c) { return c > bound; });
  });
  if (all_above) return true;
  if (depth <= 0) return false;
  for (const Quintic& half : halves(q)) {
    for (const Quintic& quarter : halves(transposed(half))) {
      if (!certify_above(bound, quarter, depth - 1)) return false;
    }
  }
  return true;
}

/// How far the tangents stay from the chord after so many rounds of shrinking.
constexpr std::array<double, 5> kShrink = {1, 0.75, 0.5, 0.25, 0};
constexpr int kLastLevel = static_cast<int>(kShrink.size()) - 1;

}  // namespace

bool certify_fold_free(const BicubicHermite<Eigen::Vector2d>& geometry, int depth) {
  const Jacobian j = jacobian(geometry);
  return certify_above(j.rounding, j.coefficients, depth);
}

FoldGuardReport guard_folds(PatchMesh& patches) {
  const QuadMesh& mesh = patches.mesh;
  FoldGuardReport report;
  std::vector<int> suspects;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    if (!certify_fold_free(patch_geometry(patches, q))) suspects.push_back(q);
  }
  report.folded_before = static_cast<int>(suspects.size());
  if (suspects.empty()) return report;

  const std::vector<std::array<Eigen::Vector2d, 2>> original = patches.edge_tangents;
  std::vector<char> level(mesh.edge_count(), 0);
  while (!suspects.empty()) {
    std::vector<int> shrunk, changed;
    for (const int q : suspects) {
      for (int k = 0; k < 4; ++k) shrunk.push_back(mesh.edge(4 * q + k));
    }
    remove_duplicates(shrunk);
    std::erase_if(shrunk, [&](int e) { return level[e] == kLastLevel; });
    if (shrunk.empty()) break;
    for (const int e : shrunk) {
      const int h = mesh.halfedge(e);
      const double keep = kShrink[++level[e]];
      const Eigen::Vector2d chord = mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)];
      for (int at = 0; at < 2; ++at) {
        patches.edge_tangents[e][at] = chord + keep * (original[e][at] - chord);
      }
      report.straightened += level[e] == kLastLevel;
      changed.push_back(QuadMesh::quad_of(h));
      if (mesh.twin(h) >= 0) changed.push_back(QuadMesh::quad_of(mesh.twin(h)));
    }
    changed.insert(changed.end(), suspects.begin(), suspects.end());
    remove_duplicates(changed);
    std::erase_if(changed, [&](int q) { return certify_fold_free(patch_geometry(patches, q)); });
    suspects = std::move(changed);
  }
  report.folded_after = static_cast<int>(suspects.size());
  return report;
}

}  // namespace quadrille
