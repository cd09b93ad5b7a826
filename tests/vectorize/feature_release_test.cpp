#include "feature_release.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr int kSide = 8;
constexpr double kLeastSine = 0.2;

/// A lattice of unit squares with a feature along its middle row, all vertices free but the
/// border's and the feature's.
struct Featured {
  QuadMesh mesh = testing::lattice(kSide, kSide, kSide, kSide);
  std::vector<VertexGuide> guides{mesh.vertices.size()};

  Featured() {
    const auto on_feature = [&](int v) { return mesh.vertices[v].y() == kSide / 2; };
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.is_border_vertex(v) || on_feature(v)) guides[v] = VertexGuide::at(mesh.vertices[v]);
    }
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const int h = mesh.halfedge(e);
      if (on_feature(mesh.origin(h)) && on_feature(mesh.tip(h))) mesh.edge_flags[e] = kFeatureEdge;
    }
  }

  int feature_edges() const {
    int count = 0;
    for (const auto flags : mesh.edge_flags) count += (flags & kFeatureEdge) != 0;
    return count;
  }
  int nearest(const Vector2d& p) const {
    int best = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      if ((mesh.vertices[v] - p).norm() < (mesh.vertices[best] - p).norm()) best = v;
    }
    return best;
  }
};

TEST(ReleaseBadFeatures, LeavesGoodMeshesAlone) {
  Featured given;
  const std::vector<Vector2d> before = given.mesh.vertices;
  release_bad_features(given.mesh, given.guides, kLeastSine);
  EXPECT_EQ(given.feature_edges(), kSide);
  EXPECT_EQ(given.mesh.vertices, before);
}

TEST(ReleaseBadFeatures, OpensQuadsThatHaveShrunkToAlmostNothing) {
  for (const double size : {1e-1, 1e-3, 1e-6}) {
    Featured given;
    // One quad beside the feature, with its corners turned about each other.
    const Vector2d middle(3.5, 4.0 + size / 2);
    const int corners[4] = {given.nearest({3, 4}), given.nearest({4, 4}), given.nearest({4, 5}),
                            given.nearest({3, 5})};
    const Vector2d turned[4] = {{1, 0}, {-1, 0.5}, {-1, 1}, {1, 1}};
    for (int k = 0; k < 4; ++k) given.mesh.vertices[corners[k]] = middle + size * turned[k];
    release_bad_features(given.mesh, given.guides, kLeastSine);
    EXPECT_TRUE(validate(given.mesh, kSide, kSide).empty()) << size;
    for (int q = 0; q < given.mesh.quad_count(); ++q) {
      EXPECT_GE(scaled_jacobian(given.mesh, q), kLeastSine) << size;
    }
    EXPECT_LT(given.feature_edges(), kSide);
  }
}

}  // namespace
}  // namespace quadrille
