#include "patch_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/random_patches.h"
#include "tile_outlines.h"

namespace quadrille {
namespace {

using testing::Random;
using testing::random_patches;

/// How often each sample of [0, width) x [0, height) is covered; samples outside are counted in
/// `outside`.
struct Coverage {
  int width, height;
  std::vector<int> count;
  int outside = 0;

  Coverage(int w, int h) : width(w), height(h), count(std::size_t{1} * w * h, 0) {}
  void add(int y, int x_begin, int x_end) {
    for (int x = x_begin; x < x_end; ++x) {
      if (x >= 0 && x < width && y >= 0 && y < height) {
        ++count[std::size_t{1} * y * width + x];
      } else {
        ++outside;
      }
    }
  }
};

TEST(PatchScan, CoversEverySampleOfAValidMeshOnce) {
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    const double width = 31, height = 23;
    const PatchMesh patches = random_patches(6, 5, width, height, seed);
    for (const double scale : {0.25, 0.7, 1.0, 2.37, 4.0, 16.0}) {
      Coverage coverage(static_cast<int>(std::round(width * scale)),
                        static_cast<int>(std::round(height * scale)));
      SampleGrid grid;
      grid.scale = {coverage.width / width, coverage.height / height};
      const PatchScan scan(patches, grid);
      for (int q = 0; q < patches.patch_count(); ++q) {
        scan.scan(q, scan.bounds(q), [&](int y, int a, int b) { coverage.add(y, a, b); });
      }
      EXPECT_EQ(coverage.outside, 0) << "seed " << seed << " scale " << scale;
      EXPECT_EQ(std::count(coverage.count.begin(), coverage.count.end(), 1),
                static_cast<long>(coverage.count.size()))
          << "seed " << seed << " scale " << scale;
    }
  }
}

TEST(PatchScan, CoversOnceAfterAnyTranslationAndMirroring) {
  const PatchMesh patches = random_patches(5, 4, 20, 15, 11);
  Random random(5);
  for (int trial = 0; trial < 12; ++trial) {
    const double x = random.uniform(3, 9), y = random.uniform(3, 9);
    const double mirror = trial % 2 ? -1 : 1;
    const Eigen::Affine2d map =
        Eigen::Translation2d(x + (mirror < 0 ? 70 : 0), y) * Eigen::Scaling(mirror * 3.3, 3.3);
    const PatchScan scan(patches, map);
    Coverage coverage(90, 70);
    for (int q = 0; q < patches.patch_count(); ++q) {
      scan.scan(q, scan.bounds(q), [&](int row, int a, int b) { coverage.add(row, a, b); });
    }
    EXPECT_EQ(coverage.outside, 0);
    EXPECT_LE(*std::max_element(coverage.count.begin(), coverage.count.end()), 1);
    const double area = 20 * 15 * 3.3 * 3.3;
    EXPECT_NEAR(std::count(coverage.count.begin(), coverage.count.end(), 1), area, 70);
  }
}

TEST(PatchScan, PatchesBesideOneCurvedEdgeLeaveNoGapAndNoOverlap) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const PatchMesh patches = random_patches(2, 1, 40, 20, seed, {0.3, 1.5});
    Coverage coverage(200, 100);
    SampleGrid grid;
    grid.scale = {5, 5};
    const PatchScan scan(patches, grid);
    for (int q = 0; q < 2; ++q) {
      scan.scan(q, scan.bounds(q), [&](int y, int a, int b) { coverage.add(y, a, b); });
    }
    EXPECT_EQ(coverage.outside, 0);
    EXPECT_TRUE(
        std::all_of(coverage.count.begin(), coverage.count.end(), [](int n) { return n == 1; }))
        << "seed " << seed;
  }
}

TEST(PatchScan, AWindowShowsWhatTheWholeShowsThere) {
  const PatchMesh patches = random_patches(4, 4, 30, 30, 9, {0.3, 1.2});
  SampleGrid grid;
  grid.scale = {2.7, 2.7};
  const PatchScan scan(patches, grid);
  Random random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const int q = random.integer(0, patches.patch_count() - 1);
    const int x = random.integer(-5, 80), y = random.integer(-5, 80);
    const SampleWindow window = {x, y, x + random.integer(1, 40), y + random.integer(1, 40)};
    Coverage part(81, 81), whole(81, 81);
    scan.scan(q, window, [&](int row, int a, int b) {
      EXPECT_TRUE(row >= window.y_begin && row < window.y_end && a < b && a >= window.x_begin &&
                  b <= window.x_end);
      part.add(row, a, b);
    });
    scan.scan(q, scan.bounds(q), [&](int row, int a, int b) {
      if (row >= window.y_begin && row < window.y_end) {
        whole.add(row, std::max(a, window.x_begin), std::min(b, window.x_end));
      }
    });
    EXPECT_EQ(part.count, whole.count);
  }
}

TEST(PatchScan, ACentreOnAnEdgeBelongsToTheRightAndBelow) {
  // Two by two unit squares moved by half a sample: all their edges run through sample centres.
  const PatchMesh patches = straight_patches(testing::lattice(2, 2, 4, 4));
  SampleGrid grid;
  grid.offset = {0.5, 0.5};
  const PatchScan scan(patches, grid);
  for (int q = 0; q < 4; ++q) {
    const SampleWindow b = scan.bounds(q);
    EXPECT_EQ(b.x_begin, q % 2 * 2);
    EXPECT_EQ(b.x_end, q % 2 * 2 + 2);
    EXPECT_EQ(b.y_begin, q / 2 * 2);
    EXPECT_EQ(b.y_end, q / 2 * 2 + 2);
    int samples = 0;
    scan.scan(q, b, [&](int, int begin, int end) { samples += end - begin; });
    EXPECT_EQ(samples, 4);
  }
}

TEST(PatchScan, StraightEdgesHaveTwoPoints) {
  PatchMesh patches = straight_patches(testing::lattice(1, 1, 7, 5));
  // Handles along the chord change the speed, not the line.
  patches.edge_tangents[0][0] *= 1.7;
  patches.edge_tangents[1][1] *= 0.4;
  const Eigen::Affine2d map(Eigen::Rotation2Dd(0.3) * Eigen::Scaling(100.0));
  const PatchScan scan(patches, map);
  for (int e = 0; e < 4; ++e) EXPECT_EQ(scan.polyline(e).size(), 2u) << "edge " << e;
}

TEST(PatchScan, RefinedAreasApproachTheExactArea) {
  const PatchMesh patches = random_patches(3, 3, 30, 30, 21, {0.25, 1.0});
  const PatchScan scan(patches, SampleGrid{});
  for (int q = 0; q < patches.patch_count(); ++q) {
    // Exact by Gauss: the Jacobian has degree 5 in each parameter, Simpson's rule on 32 pieces is
    // close enough.
    const auto geometry = patch_geometry(patches, q);
    double area = 0;
    constexpr int kSteps = 64;
    for (int j = 0; j <= kSteps; ++j) {
      for (int i = 0; i <= kSteps; ++i) {
        const auto weight = [](int k) { return k == 0 || k == kSteps ? 1 : k % 2 ? 4 : 2; };
        const double u = double(i) / kSteps, v = double(j) / kSteps;
        const Eigen::Vector2d a = geometry.derivative_u(u, v), b = geometry.derivative_v(u, v);
        area += weight(i) * weight(j) * (a.x() * b.y() - a.y() * b.x());
      }
    }
    area /= 9.0 * kSteps * kSteps;
    std::vector<SampleSpan> spans;
    scan.spans(q, scan.touched(q), 4, spans);
    long samples = 0;
    for (const SampleSpan& s : spans) samples += s.x_end - s.x_begin;
    EXPECT_NEAR(samples / 256.0, area, 0.25) << "patch " << q;
  }
}

TEST(PatchScan, RejectsWhatItCannotPlace) {
  PatchMesh patches = straight_patches(testing::lattice(1, 1, 7, 5));
  SampleGrid grid;
  grid.scale = {1e9, 1e9};
  EXPECT_THROW(PatchScan(patches, grid), std::runtime_error);
  patches.mesh.vertices[0].x() = std::nan("");
  EXPECT_THROW(PatchScan(patches, SampleGrid{}), std::runtime_error);
}

TEST(PatchScan, FarFromTheOriginNothingChanges) {
  const PatchMesh patches = random_patches(3, 2, 12, 8, 2);
  SampleGrid near, far;
  near.scale = far.scale = {8, 8};
  far.offset = {0x1p30, 0x1p29};
  const PatchScan a(patches, near), b(patches, far);
  for (int q = 0; q < patches.patch_count(); ++q) {
    std::vector<SampleSpan> spans_a, spans_b;
    a.spans(q, a.bounds(q), 0, spans_a);
    b.spans(q, b.bounds(q), 0, spans_b);
    ASSERT_EQ(spans_a.size(), spans_b.size());
    for (std::size_t i = 0; i < spans_a.size(); ++i) {
      EXPECT_EQ(spans_a[i].x_begin, spans_b[i].x_begin);
      EXPECT_EQ(spans_a[i].x_end, spans_b[i].x_end);
    }
  }
}

TEST(PatchScan, DegenerateAndFoldedPatchesEnd) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    PatchMesh patches = straight_patches(testing::lattice(2, 2, 10, 10));
    const double size = trial % 3 == 0 ? 0 : 20;
    for (auto& p : patches.mesh.vertices) {
      p = {random.uniform(0, size), trial % 5 ? random.uniform(0, size) : 3.0};
    }
    for (auto& e : patches.edge_tangents) {
      for (auto& t : e) t = {random.uniform(-50, 50), random.uniform(-50, 50)};
    }
    const PatchScan scan(patches, SampleGrid{});
    for (int q = 0; q < 4; ++q) {
      const PatchInverse inverse(patch_geometry(patches, q));
      scan.scan(q, scan.bounds(q), [&](int y, int a, int b) {
        const Eigen::Vector2d uv = inverse({(a + b) / 2.0, y + 0.5});
        EXPECT_TRUE(uv.allFinite() && uv.minCoeff() >= 0 && uv.maxCoeff() <= 1);
      });
    }
  }
}

TEST(PatchInverse, FindsTheParametersOfItsPositions) {
  for (const double curvature : {0.0, 0.6, 1.5}) {
    const PatchMesh patches = random_patches(8, 8, 64, 64, 77, {0.35, curvature});
    for (int q = 0; q < patches.patch_count(); ++q) {
      const auto geometry = patch_geometry(patches, q);
      const PatchInverse inverse(geometry);
      for (int j = 0; j <= 10; ++j) {
        for (int i = 0; i <= 10; ++i) {
          const Eigen::Vector2d uv(i / 10.0, j / 10.0), p = geometry.at(uv.x(), uv.y());
          const Eigen::Vector2d found = inverse(p);
          EXPECT_LE((geometry.at(found.x(), found.y()) - p).norm(), 8e-6) << q << " " << uv;
          EXPECT_LE((found - uv).norm(), 1e-4) << q << " " << uv;
        }
      }
    }
  }
}

TEST(PatchInverse, IsExactForParallelogramsAndClampsOutside) {
  BicubicHermite<Eigen::Vector2d> p;
  const Eigen::Vector2d a(6, 1), b(-2, 4), origin(100, 200);
  p.value = {origin, origin + a, origin + a + b, origin + b};
  p.du.fill(a);
  p.dv.fill(b);
  p.duv.fill(Eigen::Vector2d::Zero());
  const PatchInverse inverse(p);
  const Eigen::Vector2d inside = inverse(origin + 0.3 * a + 0.8 * b);
  EXPECT_NEAR(inside.x(), 0.3, 1e-12);
  EXPECT_NEAR(inside.y(), 0.8, 1e-12);
  const Eigen::Vector2d outside = inverse(origin - 0.01 * a + 0.5 * b);
  EXPECT_EQ(outside.x(), 0);
  EXPECT_NEAR(outside.y(), 0.5, 1e-12);
}

TEST(PatchInverse, ComesCloseInAFoldedPatch) {
  // Roots of the polynomial a little outside the square count and are clamped: 2 % of the size.
  Random random(8);
  for (int trial = 0; trial < 60; ++trial) {
    BicubicHermite<Eigen::Vector2d> p;
    const auto draw = [&] { return Eigen::Vector2d(random.uniform(-9, 9), random.uniform(-9, 9)); };
    for (int k = 0; k < 4; ++k) {
      p.value[k] = draw(), p.du[k] = draw(), p.dv[k] = draw(), p.duv[k] = draw();
    }
    const PatchInverse inverse(p);
    for (int i = 0; i < 10; ++i) {
      const Eigen::Vector2d target = p.at(random.uniform(), random.uniform());
      const Eigen::Vector2d found = inverse(target);
      EXPECT_LE((p.at(found.x(), found.y()) - target).norm(), 0.02 * 18) << "trial " << trial;
    }
  }
}

/// Quads moved and curved so little that none folds, without a search for folds; quick to make.
PatchMesh slightly_curved(int side, double size, std::uint32_t seed) {
  Random random(seed);
  PatchMesh patches = straight_patches(testing::lattice(side, side, size, size));
  const double reach = 0.15 * size / side;
  const auto move = [&] {
    return Eigen::Vector2d(random.uniform(-reach, reach), random.uniform(-reach, reach));
  };
  for (auto& p : patches.mesh.vertices) {
    if (p.minCoeff() > 0 && p.maxCoeff() < size) p += move();
  }
  for (int e = 0; e < patches.mesh.edge_count(); ++e) {
    const int h = patches.mesh.halfedge(e);
    const Eigen::Vector2d chord =
        patches.mesh.vertices[patches.mesh.tip(h)] - patches.mesh.vertices[patches.mesh.origin(h)];
    patches.edge_tangents[e] = {chord, chord};
    if (patches.mesh.is_border(e)) continue;
    for (auto& t : patches.edge_tangents[e]) t += move();
  }
  return patches;
}

TEST(PatchScan, AMillionEdgesAreTheSameFromBothSides) {
  constexpr int kMeshes = 250, kSide = 44;  // 44 x 44 quads have some 4,000 edges
  long long edges = 0, wrong = 0;
  for (std::uint32_t seed = 0; seed < kMeshes; ++seed) {
    const PatchMesh patches = slightly_curved(kSide, 200, seed);
    Coverage coverage(200, 200);
    const PatchScan scan(patches, SampleGrid{});
    for (int q = 0; q < patches.patch_count(); ++q) {
      scan.scan(q, scan.bounds(q), [&](int y, int a, int b) { coverage.add(y, a, b); });
    }
    wrong += coverage.outside;
    for (const int n : coverage.count) wrong += n != 1;
    edges += patches.mesh.edge_count();
  }
  EXPECT_GT(edges, 960'000);
  EXPECT_EQ(wrong, 0);
}

TEST(TileOutlines, AgreesWithTheGeneralScan) {
  Random random(12);
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    PatchMesh patches = random_patches(5, 4, 60, 50, seed, {0.3, 1.5});
    if (seed % 4 == 0) {  // folded and torn apart
      for (auto& p : patches.mesh.vertices) p += Eigen::Vector2d(random.uniform(-9, 9), 0);
    }
    const double scale = seed % 3 == 0 ? 700 : random.uniform(0.5, 6);  // also long segments
    SampleGrid grid;
    grid.scale = {scale, seed % 5 == 0 ? -scale : scale};
    grid.offset = {0, seed % 5 == 0 ? 50 * scale : 0};
    const PatchScan scan(patches, grid);
    TileOutlines outlines;
    std::vector<SampleSpan> expected, found;
    for (int trial = 0; trial < 20; ++trial) {
      const int x = random.integer(-10, static_cast<int>(60 * scale));
      const int y = random.integer(-10, static_cast<int>(50 * scale));
      const SampleWindow window = {x, y, x + random.integer(1, 128), y + random.integer(1, 128)};
      outlines.start(scan, window);
      for (int q = 0; q < patches.patch_count(); ++q) {
        scan.spans(q, window, 0, expected);
        outlines.spans(q, found);
        EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found.begin(), found.end(),
                               [](const SampleSpan& a, const SampleSpan& b) {
                                 return a.y == b.y && a.x_begin == b.x_begin && a.x_end == b.x_end;
                               }))
            << "seed " << seed << " patch " << q;
      }
    }
  }
}

}  // namespace
}  // namespace quadrille
