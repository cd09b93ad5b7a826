#include "document_shapes.h"

#include <algorithm>
#include <cmath>

#include "quadrille/patch_geometry.h"

namespace quadrille {
namespace {

Eigen::Vector2d chord_of(const QuadMesh& mesh, int e) {
  const int h = mesh.halfedge(e);
  return mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)];
}

/// The tangents of level `level`; level 0 gives `bessel` bit for bit.
EdgeTangents drawn_in(const EdgeTangents& bessel, const Eigen::Vector2d& chord, int level) {
  if (level == 0) return bessel;
  EdgeTangents t;
  for (int at = 0; at < 2; ++at) t[at] = chord + kKeep[level] * (bessel[at] - chord);
  return t;
}

bool are_near(const EdgeTangents& a, const EdgeTangents& b, double position_step) {
  // Far above rounding and far below a step.
  const double tolerance = 1e-6 * position_step;
  return (a[0] - b[0]).lpNorm<Eigen::Infinity>() <= tolerance &&
         (a[1] - b[1]).lpNorm<Eigen::Infinity>() <= tolerance;
}

EdgeShape shape_of(const EdgeTangents& tangents, const EdgeTangents& bessel,
                   const Eigen::Vector2d& chord, double position_step) {
  EdgeShape shape;
  for (shape.level = 0; shape.level <= EdgeShape::kStraight; ++shape.level) {
    if (are_near(tangents, drawn_in(bessel, chord, shape.level), position_step)) return shape;
  }
  bool any = false;
  for (int i = 0; i < 4; ++i) {
    const double deviation = tangents[i / 2][i % 2] - bessel[i / 2][i % 2];
    const double steps = deviation / (kTangentSteps * position_step);
    shape.deviation[i] = static_cast<int>(std::floor(steps + 0.5));
    any = any || shape.deviation[i] != 0;
  }
  shape.level = any ? EdgeShape::kFree : 0;
  return shape;
}

std::vector<EdgeTangents> bessel_tangents(const QuadMesh& mesh) {
  PatchMesh patches;
  patches.mesh = mesh;
  patches.edge_tangents.resize(mesh.edge_count());
  set_bessel_tangents(patches);
  return std::move(patches.edge_tangents);
}

std::vector<EdgeShape> shapes_of(const QuadMesh& mesh, const std::vector<EdgeTangents>& tangents,
                                 const std::vector<EdgeTangents>& bessel, double position_step) {
  std::vector<EdgeShape> shapes;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    shapes.push_back(shape_of(tangents[e], bessel[e], chord_of(mesh, e), position_step));
  }
  return shapes;
}

std::vector<EdgeTangents> tangents_of(const QuadMesh& mesh, const std::vector<EdgeShape>& shapes,
                                      std::vector<EdgeTangents> bessel, double position_step) {
  for (std::size_t e = 0; e < shapes.size(); ++e) {
    EdgeTangents& t = bessel[e];
    if (shapes[e].level != EdgeShape::kFree) {
      t = drawn_in(t, chord_of(mesh, static_cast<int>(e)), shapes[e].level);
      continue;
    }
    for (int i = 0; i < 4; ++i) {
      t[i / 2][i % 2] += shapes[e].deviation[i] * (kTangentSteps * position_step);
    }
  }
  return bessel;
}

/// Changes shapes into those that their tangents are recognised as; some may become simpler.
/// Returns the tangents.
std::vector<EdgeTangents> settle(const QuadMesh& mesh, const std::vector<EdgeTangents>& bessel,
                                 double position_step, std::vector<EdgeShape>& shapes) {
  for (;;) {
    std::vector<EdgeTangents> tangents = tangents_of(mesh, shapes, bessel, position_step);
    std::vector<EdgeShape> again = shapes_of(mesh, tangents, bessel, position_step);
    if (again == shapes) return tangents;
    shapes = std::move(again);
  }
}

}  // namespace

void set_tangents(double position_step, QuantizedPatches& patches) {
  patches.tangents =
      tangents_of(patches.mesh, patches.shapes, bessel_tangents(patches.mesh), position_step);
}

bool are_same_tangents(const std::vector<EdgeTangents>& a, const std::vector<EdgeTangents>& b,
                       double position_step) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const auto& t, const auto& u) { return are_near(t, u, position_step); });
}

int quantize_tangents(const PatchMesh& patches, double position_step, QuantizedPatches& moved) {
  const QuadMesh& mesh = moved.mesh;
  std::vector<EdgeShape>& shapes = moved.shapes;
  shapes =
      shapes_of(patches.mesh, patches.edge_tangents, bessel_tangents(patches.mesh), position_step);
  const std::vector<EdgeTangents> bessel = bessel_tangents(mesh);
  PatchMesh curved;
  curved.mesh = mesh;
  curved.edge_tangents = settle(mesh, bessel, position_step, shapes);
  std::vector<char> must_hold(mesh.quad_count());
  for (int q = 0; q < mesh.quad_count(); ++q) {
    must_hold[q] = certify_fold_free(patch_geometry(patches, q));
  }
  std::vector<int> raised(mesh.edge_count(), 0);
  int folded;
  for (;;) {
    folded = 0;
    std::vector<int> raise;
    for (int q = 0; q < mesh.quad_count(); ++q) {
      if (!must_hold[q] || certify_fold_free(patch_geometry(curved, q))) continue;
      ++folded;
      for (int k = 0; k < 4; ++k) raise.push_back(mesh.edge(4 * q + k));
    }
    // A quad that folds even with straight edges stays as it is.
    std::erase_if(raise, [&](int e) { return raised[e] == EdgeShape::kStraight; });
    if (raise.empty()) break;
    std::sort(raise.begin(), raise.end());
    raise.erase(std::unique(raise.begin(), raise.end()), raise.end());
    for (const int e : raise) {
      const int level = shapes[e].level;
      raised[e] = level == EdgeShape::kFree ? EdgeShape::kStraight : std::max(raised[e], level) + 1;
      shapes[e] = {std::min(raised[e], EdgeShape::kStraight), {}};
      raised[e] = shapes[e].level;
    }
    curved.edge_tangents = settle(mesh, bessel, position_step, shapes);
  }
  moved.tangents = std::move(curved.edge_tangents);
  return folded;
}

}  // namespace quadrille
