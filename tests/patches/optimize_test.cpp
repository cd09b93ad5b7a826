#include "quadrille/optimize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "exactly_opaque.h"
#include "paint.h"
#include "patch_scan.h"
#include "quadrille/error.h"
#include "quadrille/patch_geometry.h"
#include "support/irregular_mesh.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using testing::irregular_mesh;
using testing::lattice;
using testing::paint;

/// Samples per pixel along a side.
constexpr int kFineness = 4;

/// A bright disc that fades over `blur` pixels at its rim.
Raster disc(int width, int height, double blur, int channels = 3) {
  return paint(width, height, channels, kFineness,
               [&](double x, double y) -> std::array<double, 4> {
                 const double r = std::hypot(x - 0.47 * width, y - 0.52 * height) - 0.31 * height;
                 const double inside = 1 / (1 + std::exp(r / blur));
                 return {0.1 + 0.8 * inside, 0.7 - 0.5 * inside, 0.3, 0.2 + 0.7 * inside};
               });
}

double smallest_jacobian(const QuadMesh& mesh) {
  double smallest = 1;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    smallest = std::min(smallest, scaled_jacobian(mesh, q));
  }
  return smallest;
}

double mean_squared_error(const PatchMesh& patches, const Raster& picture) {
  double sum = 0;
  const PatchScan scan(patches, SampleGrid{});
  for (int q = 0; q < patches.patch_count(); ++q) {
    const FergusonPatch patch = ferguson_patch(patches, q);
    const PatchInverse inverse(patch.position);
    scan.scan(q, intersection(scan.bounds(q), {0, 0, picture.width, picture.height}),
              [&](int y, int x_begin, int x_end) {
                for (int x = x_begin; x < x_end; ++x) {
                  const Vector2d uv = inverse({x + 0.5, y + 0.5});
                  const Color shown = patch.color.at(uv.x(), uv.y());
                  const float* const p = picture.pixel(x, y);
                  const float alpha = picture.has_alpha() ? p[3] : 1;
                  for (int k = 0; k < picture.channels; ++k) {
                    const double e = shown[k] - (k < 3 ? p[k] * alpha : alpha);
                    sum += e * e;
                  }
                }
              });
  }
  return sum / static_cast<double>(picture.data.size());
}

bool same(const PatchMesh& a, const PatchMesh& b) {
  const auto same_bytes = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  return same_bytes(a.mesh.vertices, b.mesh.vertices) &&
         same_bytes(a.edge_tangents, b.edge_tangents) && same_bytes(a.wedges, b.wedges);
}

void expect_sound(const PatchMesh& before, const PatchMesh& after, double width, double height) {
  EXPECT_TRUE(validate(after.mesh, width, height).empty());
  EXPECT_GE(smallest_jacobian(after.mesh), std::min(0.2, smallest_jacobian(before.mesh)) - 1e-12);
  for (int q = 0; q < after.patch_count(); ++q) {
    EXPECT_TRUE(certify_fold_free(patch_geometry(after, q)));
  }
}

TEST(Optimize, LowersTheErrorOfSmoothAndSharpPictures) {
  for (const double blur : {2.0, 0.2}) {
    for (const int channels : {3, 4}) {
      const Raster picture = disc(96, 72, blur, channels);
      const PatchMesh before = fit_patches(lattice(12, 9, 96, 72), picture);
      PatchMesh after = before;
      const OptimizeReport report = optimize_vertices(after, picture);
      const double error = mean_squared_error(after, picture);
      EXPECT_LT(error, 0.6 * mean_squared_error(before, picture)) << blur << " " << channels;
      EXPECT_NEAR(report.mse_before, mean_squared_error(before, picture), 0.01 * report.mse_before);
      EXPECT_NEAR(report.mse_after, error, 0.05 * error);
      EXPECT_EQ(report.rounds.size(), 8u);
      EXPECT_GE(report.accepted, 3);
      expect_sound(before, after, 96, 72);
    }
  }
}

TEST(Optimize, KeepsIrregularMeshesSound) {
  const Raster picture = disc(90, 70, 1);
  for (int seed = 0; seed < 3; ++seed) {
    const PatchMesh before = fit_patches(irregular_mesh(5, 4, 90, 70, seed), picture);
    PatchMesh after = before;
    EXPECT_GT(optimize_vertices(after, picture).accepted, 0);
    expect_sound(before, after, 90, 70);
  }
}

TEST(Optimize, GathersVerticesAtABend) {
  const Raster picture = paint(64, 16, 3, kFineness, [](double x, double) -> std::array<double, 4> {
    const double roof = std::abs(x - 29.3) / 64;
    return {0.2 + roof, 0.9 - roof, 0.5, 1};
  });
  PatchMesh patches = fit_patches(lattice(8, 2, 64, 16), picture);
  OptimizeOptions options;
  options.rounds = 20;
  const OptimizeReport report = optimize_vertices(patches, picture, options);
  EXPECT_LT(report.mse_after, 0.25 * report.mse_before);
}

TEST(Optimize, LeavesLinearPicturesAtNoError) {
  const Raster picture =
      paint(60, 44, 3, kFineness, [](double x, double y) -> std::array<double, 4> {
        return {0.2 + 0.004 * x + 0.002 * y, 0.7 - 0.003 * x, 0.5, 1};
      });
  PatchMesh patches = fit_patches(irregular_mesh(5, 4, 60, 44, 1), picture);
  optimize_vertices(patches, picture);
  EXPECT_LT(mean_squared_error(patches, picture), 1e-11);
  EXPECT_TRUE(validate(patches.mesh, 60, 44).empty());
}

TEST(Optimize, SurvivesConstantPicturesAndPatchesSmallerThanPixels) {
  OptimizeOptions without_shape;
  without_shape.shape_weight = 0;
  constexpr int kSizes[][2] = {{1, 1}, {3, 2}, {40, 30}};
  for (const auto& [width, height] : kSizes) {
    for (const OptimizeOptions& options : {OptimizeOptions(), without_shape}) {
      for (const Raster& picture :
           {Raster(width, height, 4), disc(width, height, 1, 3), Raster(width, height, 3)}) {
        PatchMesh patches = fit_patches(irregular_mesh(4, 4, width, height, 3), picture);
        optimize_vertices(patches, picture, options);
        EXPECT_TRUE(validate(patches.mesh, width, height).empty());
        for (const Wedge& w : patches.wedges) {
          EXPECT_TRUE(w.value.allFinite() && w.dx.allFinite() && w.dy.allFinite());
        }
      }
    }
  }
}

TEST(Optimize, KeepsRgbExactlyOpaque) {
  const Raster picture = disc(48, 48, 2);
  PatchMesh patches = fit_patches(lattice(6, 6, 48, 48), picture);
  optimize_vertices(patches, picture);
  testing::expect_exactly_opaque(patches);
}

TEST(Optimize, KeepsTheOutlineOfARegion) {
  // A ring of quads around a square hole, inside the picture; its outer border is an octagon.
  QuadMesh whole = lattice(6, 6, 60, 60);
  std::vector<QuadMesh::Quad> quads;
  for (const auto& q : whole.quads()) {
    const Vector2d middle = 0.5 * (whole.vertices[q[0]] + whole.vertices[q[2]]);
    if ((middle - Vector2d(30, 30)).cwiseAbs().maxCoeff() > 10) quads.push_back(q);
  }
  std::vector<int> number(whole.vertex_count(), -1);
  std::vector<Vector2d> vertices;
  for (auto& q : quads) {
    for (int& v : q) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(vertices.size());
        const Vector2d offset = whole.vertices[v] - Vector2d(30, 30);
        const bool corner = offset.cwiseAbs().minCoeff() > 29;
        vertices.push_back(Vector2d(32, 31) + (corner ? 0.85 : 1.0) * offset);
      }
      v = number[v];
    }
  }
  const Raster picture = disc(66, 64, 1.5, 4);
  const PatchMesh before = fit_patches(QuadMesh(vertices, quads), picture);
  PatchMesh after = before;
  EXPECT_GT(optimize_vertices(after, picture).accepted, 0);
  int slid = 0, moved = 0;
  for (int v = 0; v < after.mesh.vertex_count(); ++v) {
    const Vector2d step = after.mesh.vertices[v] - before.mesh.vertices[v];
    if (!after.mesh.is_border_vertex(v)) {
      moved += step.norm() > 0.01;
      continue;
    }
    EXPECT_TRUE(step.x() == 0 || step.y() == 0);
    slid += step.norm() > 0.01;
  }
  EXPECT_GT(slid, 0);
  EXPECT_GT(moved, 0);
  double area_before = 0, area_after = 0;
  for (int q = 0; q < after.patch_count(); ++q) {
    const auto area = [&](const QuadMesh& mesh) {
      const auto& c = mesh.quads()[q];
      const Vector2d d = mesh.vertices[c[2]] - mesh.vertices[c[0]];
      const Vector2d e = mesh.vertices[c[3]] - mesh.vertices[c[1]];
      return 0.5 * (d.x() * e.y() - d.y() * e.x());
    };
    area_before += area(before.mesh);
    area_after += area(after.mesh);
  }
  EXPECT_NEAR(area_after, area_before, 1e-9 * area_before);
}

/// The distance of p from the curves of the tear edges.
double distance_to_tears(const PatchMesh& patches, const Vector2d& p) {
  double nearest = 1e300;
  for (int e = 0; e < patches.mesh.edge_count(); ++e) {
    if (!patches.mesh.is_tear(e)) continue;
    const int h = patches.mesh.halfedge(e);
    for (int i = 0; i <= 1000; ++i) {
      const auto b = hermite_basis(i / 1000.0);
      const Vector2d at = patches.mesh.vertices[patches.mesh.origin(h)] * b[0] +
                          tangent_along(patches, h, 0) * b[1] +
                          patches.mesh.vertices[patches.mesh.tip(h)] * b[2] +
                          tangent_along(patches, h, 1) * b[3];
      nearest = std::min(nearest, (at - p).norm());
    }
  }
  return nearest;
}

TEST(Optimize, SlidesTornVerticesAlongTheirChain) {
  // Rows of a lattice bent along sin; the middle row is torn from the second column to the last
  // but one, and one vertex of it also has a tear that leads up.
  constexpr int kColumns = 10, kRows = 6;
  QuadMesh mesh = lattice(kColumns, kRows, 100, 60);
  const auto bend = [](double x) { return 6 * std::sin(x / 16); };
  for (Vector2d& p : mesh.vertices) p.y() += bend(p.x()) * (1 - std::abs(p.y() - 30) / 30);
  const auto vertex = [&](int i, int j) { return j * (kColumns + 1) + i; };
  const auto tear = [&](int a, int b) {
    for (int h = 0; h < mesh.halfedge_count(); ++h) {
      if (mesh.origin(h) == a && mesh.tip(h) == b) mesh.edge_flags[mesh.edge(h)] |= kTearEdge;
    }
  };
  for (int i = 1; i < kColumns - 1; ++i) {
    tear(vertex(i, 3), vertex(i + 1, 3));
    tear(vertex(i + 1, 3), vertex(i, 3));
  }
  tear(vertex(7, 3), vertex(7, 2));
  tear(vertex(7, 2), vertex(7, 3));
  const Raster picture =
      paint(100, 60, 3, kFineness, [&](double x, double y) -> std::array<double, 4> {
        const bool below = y > 30 + bend(x);
        const double wave = 0.2 * std::sin(0.3 * x + 0.002 * x * x);
        return {below ? 0.8 - wave : 0.2 + wave, below ? 0.3 : 0.5, 0.4 + wave, 1};
      });
  const PatchMesh before = fit_patches(mesh, picture);
  OptimizeOptions one_round;
  one_round.rounds = 1;
  PatchMesh after = before;
  ASSERT_EQ(optimize_vertices(after, picture, one_round).accepted, 1);
  int slid = 0;
  for (int i = 1; i < kColumns; ++i) {
    const int v = vertex(i, 3);
    const Vector2d step = after.mesh.vertices[v] - before.mesh.vertices[v];
    if (i == 1 || i == kColumns - 1 || i == 7) {
      EXPECT_EQ(step.norm(), 0) << i;
    } else {
      EXPECT_LT(distance_to_tears(before, after.mesh.vertices[v]), 0.02) << i;
      slid += step.norm() > 0.1;
    }
  }
  EXPECT_EQ(after.mesh.vertices[vertex(7, 2)], before.mesh.vertices[vertex(7, 2)]);
  EXPECT_GT(slid, 2);
  expect_sound(before, after, 100, 60);
}

TEST(Optimize, TradesErrorForShapeByTheWeight) {
  const Raster picture = disc(96, 96, 0.5);
  const PatchMesh before = fit_patches(lattice(12, 12, 96, 96), picture);
  double last_error = 0, last_shape = 0;
  for (const double weight : {0.001, 0.02, 0.4}) {
    OptimizeOptions options;
    options.shape_weight = weight;
    PatchMesh after = before;
    const double error = optimize_vertices(after, picture, options).mse_after;
    double shape = 0;
    for (int q = 0; q < after.patch_count(); ++q) shape += scaled_jacobian(after.mesh, q);
    if (last_error > 0) {
      EXPECT_GT(shape, last_shape);
      EXPECT_GT(error, 0.9 * last_error);
    }
    last_error = error;
    last_shape = shape;
  }
}

TEST(Optimize, IsTheSameForAnyNumberOfThreads) {
  const Raster picture = disc(120, 90, 1, 4);
  const PatchMesh before = fit_patches(irregular_mesh(12, 9, 120, 90, 5), picture);
  const auto optimized = [&](int threads) {
    RunContext context;
    context.threads = threads;
    OptimizeOptions options;
    options.rounds = 3;
    PatchMesh patches = before;
    optimize_vertices(patches, picture, options, {}, context);
    return patches;
  };
  const PatchMesh one = optimized(1);
  EXPECT_FALSE(same(one, before));
  EXPECT_TRUE(same(one, optimized(2)));
  EXPECT_TRUE(same(one, optimized(4)));
}

TEST(Optimize, DoesNothingInNoRoundsOrForSampledColours) {
  const Raster picture = disc(48, 48, 1);
  const PatchMesh before = fit_patches(lattice(6, 6, 48, 48), picture);
  PatchMesh after = before;
  OptimizeOptions options;
  options.rounds = 0;
  EXPECT_TRUE(optimize_vertices(after, picture, options).rounds.empty());
  FitOptions sampled;
  sampled.method = FitMethod::bessel;
  EXPECT_TRUE(optimize_vertices(after, picture, {}, sampled).rounds.empty());
  EXPECT_TRUE(same(before, after));
}

TEST(Optimize, TakesNoRoundWithoutAPixelCentre) {
  const Raster picture = disc(8, 8, 1);
  QuadMesh mesh = lattice(2, 2, 0.4, 0.4);  // the first pixel has its centre at (0.5, 0.5)
  const PatchMesh before = fit_patches(mesh, picture);
  PatchMesh after = before;
  const OptimizeReport report = optimize_vertices(after, picture);
  EXPECT_TRUE(report.rounds.empty());
  EXPECT_EQ(report.mse_before, 0);
  EXPECT_EQ(report.mse_after, 0);
  EXPECT_TRUE(same(before, after));
}

TEST(Optimize, RefusesQuadsThatAreNotStrictlyConvex) {
  const Raster picture = disc(40, 40, 1);
  PatchMesh patches = fit_patches(lattice(4, 4, 40, 40), picture);
  const Vector2d good = patches.mesh.vertices[6];  // (10, 10), a corner of quad 0 and of 5
  for (const Vector2d& bad : {Vector2d(15, 15), Vector2d(17, 17)}) {  // flat, and reflex
    patches.mesh.vertices[6] = bad;
    for (const double weight : {0.0, 0.02}) {
      OptimizeOptions options;
      options.shape_weight = weight;
      try {
        optimize_vertices(patches, picture, options);
        ADD_FAILURE() << bad.transpose() << ", " << weight;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
      }
    }
  }
  patches.mesh.vertices[6] = good;
  OptimizeOptions free;
  free.shape_weight = 0;
  EXPECT_GT(optimize_vertices(patches, picture, free).accepted, 0);
}

TEST(Optimize, RefusesWhatItCannotDo) {
  const Raster picture(8, 8, 3);
  const auto code_of = [&](PatchMesh patches, const Raster& shown, const OptimizeOptions& options,
                           const FitOptions& fit = {}, const RunContext& context = {}) {
    try {
      optimize_vertices(patches, shown, options, fit, context);
    } catch (const Error& e) {
      return e.code();
    }
    return ErrorCode::numerical_failure;
  };
  const PatchMesh patches = fit_patches(lattice(2, 2, 8, 8), picture);
  OptimizeOptions options;
  options.rounds = -1;
  EXPECT_EQ(code_of(patches, picture, options), ErrorCode::invalid_argument);
  options = {};
  options.shape_weight = std::nan("");
  EXPECT_EQ(code_of(patches, picture, options), ErrorCode::invalid_argument);
  options = {};
  options.min_scaled_jacobian = 1;
  EXPECT_EQ(code_of(patches, picture, options), ErrorCode::invalid_argument);
  FitOptions fit;
  fit.tolerance = 0;
  EXPECT_EQ(code_of(patches, picture, {}, fit), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of({}, picture, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(patches, Raster(), {}), ErrorCode::invalid_argument);
  RunContext context;
  context.on_progress = [](const std::string&, double) { return false; };
  EXPECT_EQ(code_of(patches, picture, {}, {}, context), ErrorCode::cancelled);
}

}  // namespace
}  // namespace quadrille
