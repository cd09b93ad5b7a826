// Meshing again where a fit errs, along chains.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "adversarial_pictures.h"
#include "box_filtered.h"
#include "quadrille/error.h"
#include "quadrille/render.h"
#include "quadrille/tears.h"
#include "quadrille/vectorize.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using test::disc_picture;

/// What the picture's fit to the mesh shows.
Raster drawn(const QuadMesh& mesh, const Raster& picture) {
  return render(single_layer(fit_patches(mesh, picture, {.method = FitMethod::bessel}),
                             picture.width, picture.height));
}

VectorizeOptions with_all_chains(int quads) {
  VectorizeOptions options{.quads = quads};
  options.tears.mode = TearOptions::Mode::strong;
  options.least_chain_gain = 0;
  return options;
}

double smallest_jacobian(const QuadMesh& mesh) {
  double smallest = 1;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    smallest = std::min(smallest, scaled_jacobian(mesh, q));
  }
  return smallest;
}

TEST(RefineByError, FeatureEdgesCloseAroundADisc) {
  const Vector2d centre(48.3, 47.6);
  for (const double radius : {15.0, 30.0}) {
    const Raster picture = disc_picture(96, 96, centre, radius);
    for (const int quads : {300, 800}) {
      SCOPED_TRACE(std::to_string(radius) + " at " + std::to_string(quads));
      const VectorizeOptions options = with_all_chains(quads);
      Quadrangulation result = quadrangulate(picture, options);
      EXPECT_TRUE(feature_edge_chains(result.mesh).empty());
      refine_by_error(result, picture, drawn(result.mesh, picture), options);
      const QuadMesh& mesh = result.mesh;
      EXPECT_TRUE(validate(mesh, 96, 96).empty());
      EXPECT_NEAR(mesh.quad_count(), quads, 0.05 * quads);
      EXPECT_EQ(result.chains.chains.size(), 1u);
      std::vector<int> edges_at(mesh.vertex_count(), 0);
      std::vector<double> chord_at(mesh.vertex_count(), 0);
      double length = 0;
      for (int e = 0; e < mesh.edge_count(); ++e) {
        if (!(mesh.edge_flags[e] & kFeatureEdge)) continue;
        const int h = mesh.halfedge(e), a = mesh.origin(h), b = mesh.tip(h);
        ++edges_at[a], ++edges_at[b];
        const double side = (mesh.vertices[b] - mesh.vertices[a]).norm();
        chord_at[a] += side, chord_at[b] += side;
        length += side;
      }
      for (int v = 0; v < mesh.vertex_count(); ++v) {
        EXPECT_THAT(edges_at[v], testing::AnyOf(0, 2)) << "open at " << v;
        if (edges_at[v] == 0) continue;
        // A vertex that slides leaves the chain a little; where a bend would ruin a corner it stays
        // on the chord of its neighbours.
        const double sagitta = chord_at[v] * chord_at[v] / (8 * radius);
        EXPECT_NEAR((mesh.vertices[v] - centre).norm(), radius, std::max(0.15, 0.05 + sagitta));
      }
      EXPECT_NEAR(length, 2 * std::numbers::pi * radius, 0.05 * length);
    }
  }
}

TEST(RefineByError, PutsQuadsWhereTheErrorIs) {
  std::mt19937 random(7);
  Raster picture(120, 80, 3), fitted(120, 80, 3);
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 120; ++x) {
      for (int c = 0; c < 3; ++c) {
        picture.pixel(x, y)[c] = 0.5f + 0.2f * static_cast<float>(std::sin(0.1 * x + 0.07 * y));
        const float error = 0.1f * (static_cast<float>(random() % 256) / 255 - 0.5f);
        fitted.pixel(x, y)[c] = picture.pixel(x, y)[c] + (x < 60 ? 0 : error);
      }
    }
  }
  VectorizeOptions options{.quads = 600};
  Quadrangulation result = quadrangulate(picture, options);
  const auto share_on_the_right = [&] {
    double count = 0;
    for (const QuadMesh::Quad& quad : result.mesh.quads()) {
      double x = 0;
      for (const int v : quad) x += result.mesh.vertices[v].x() / 4;
      count += x > 60;
    }
    return count / result.mesh.quad_count();
  };
  EXPECT_NEAR(share_on_the_right(), 0.5, 0.1);
  refine_by_error(result, picture, fitted, options);
  EXPECT_GT(share_on_the_right(), 0.65);
  EXPECT_TRUE(validate(result.mesh, 120, 80).empty());
  EXPECT_NEAR(result.mesh.quad_count(), 600, 30);
}

TEST(RefineByError, LeavesALatticeAsItIs) {
  const Raster picture = disc_picture(48, 48, {24, 24}, 12);
  const VectorizeOptions options{.quads = 100, .lattice = true};
  Quadrangulation result = quadrangulate(picture, options);
  const std::vector<Vector2d> before = result.mesh.vertices;
  refine_by_error(result, picture, Raster(48, 48, 3), options);
  EXPECT_EQ(result.mesh.vertices, before);
}

TEST(RefineByError, RefusesAFitOfAnotherSize) {
  const Raster picture = disc_picture(48, 48, {24, 24}, 12);
  Quadrangulation result = quadrangulate(picture, {.quads = 100});
  EXPECT_THROW(refine_by_error(result, picture, Raster(48, 47, 3), {.quads = 100}), Error);
}

TEST(RefineByError, RefusesOptionsAndPicturesAsQuadrangulateDoes) {
  const Raster picture = disc_picture(48, 48, {24, 24}, 12);
  const Quadrangulation meshed = quadrangulate(picture, {.quads = 100});
  const auto code_of = [&](const Raster& shown, const Raster& fitted, VectorizeOptions options) {
    Quadrangulation result = meshed;
    try {
      refine_by_error(result, shown, fitted, options);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::numerical_failure;
  };
  EXPECT_EQ(code_of(picture, picture, {.quads = 0}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(picture, picture, {.quads = kMaxQuads + 1}), ErrorCode::limit_exceeded);
  EXPECT_EQ(code_of(picture, picture, {.chain_share = 2}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(picture, picture, {.optimize = {.rounds = -1}}), ErrorCode::invalid_argument);
  Raster broken = picture;
  broken.data[0] = std::nanf("");
  EXPECT_EQ(code_of(picture, broken, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(broken, picture, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(Raster(), picture, {}), ErrorCode::invalid_argument);
}

TEST(RefineByError, AnyPictureEndsInAGoodMeshAlongItsChains) {
  constexpr int kPicturesPerFamily = 4;
  constexpr double kSmallestJacobian = 0.15;
  std::vector<std::string> invalid, shape;
  int with_chains = 0;
  for (const test::PictureFamily& family : test::adversarial_families()) {
    std::seed_seq seed(family.name.begin(), family.name.end());
    std::mt19937 random(seed);
    for (int i = 0; i < kPicturesPerFamily; ++i) {
      const int w = test::log_uniform(random, 16, 120), h = test::log_uniform(random, 16, 120);
      const VectorizeOptions options = with_all_chains(test::log_uniform(random, 20, 1500));
      const Raster picture = family.draw(random, w, h);
      const std::string name =
          family.name + " #" + std::to_string(i) + " (" + std::to_string(picture.width) + "x" +
          std::to_string(picture.height) + " at " + std::to_string(options.quads) + ")";
      Quadrangulation result = quadrangulate(picture, options);
      if (result.fallback) continue;
      refine_by_error(result, picture, drawn(result.mesh, picture), options);
      with_chains += !result.chains.chains.empty();
      const auto violations = validate(result.mesh, picture.width, picture.height);
      if (!violations.empty()) invalid.push_back(name + ": " + violations.front().what);
      const double jacobian = smallest_jacobian(result.mesh);
      if (jacobian < kSmallestJacobian) shape.push_back(name + ": " + std::to_string(jacobian));
    }
  }
  EXPECT_GT(with_chains, 10);
  EXPECT_THAT(invalid, testing::IsEmpty());
  EXPECT_THAT(shape, testing::IsEmpty());
}

}  // namespace
}  // namespace quadrille
