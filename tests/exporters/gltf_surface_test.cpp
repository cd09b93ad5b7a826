// How glTF surfaces are cut into polygons, and what their vertices carry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "exporters/gltf_file.h"
#include "gltf_pattern.h"
#include "quadrille/document.h"
#include "sheeted_layer.h"
#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

using test::GltfFile;
using test::written;

/// The polygons cover the patch: every side of one is that of another the other way round, or a
/// segment of the patch's sides; and Euler's formula holds for a disc.
void expect_disc(const PatchPattern& pattern) {
  std::set<std::pair<int, int>> sides;
  std::set<int> vertices;
  for (const Polygon& p : pattern.polygons()) {
    const int n = p[3] < 0 ? 3 : 4;
    for (int k = 0; k < n; ++k) {
      EXPECT_TRUE(sides.emplace(p[k], p[(k + 1) % n]).second);
      vertices.insert(p[k]);
    }
  }
  std::set<std::pair<int, int>> border;
  for (const auto& [from, to] : sides) {
    if (!sides.contains({to, from})) border.emplace(from, to);
  }
  std::set<std::pair<int, int>> expected;
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < pattern.segments(side); ++i) {
      expected.emplace(pattern.on_side(side, i), pattern.on_side(side, i + 1));
    }
  }
  EXPECT_EQ(border, expected);
  EXPECT_EQ(static_cast<int>(vertices.size()), pattern.vertex_count());
  const int edges = static_cast<int>(sides.size() + border.size()) / 2;
  EXPECT_EQ(pattern.vertex_count() - edges + static_cast<int>(pattern.polygons().size()), 1);
}

TEST(GltfPattern, CoversThePatchForAnyDivisionOfItsSides) {
  for (int code = 0; code < 4 * 4 * 4 * 4; ++code) {
    const std::array<int, 4> n = {code % 4 + 1, code / 4 % 4 + 1, code / 16 % 4 + 1, code / 64 + 1};
    std::array<int, 2> grid = {std::max(n[0], n[2]), std::max(n[1], n[3])};
    // One row more where the transitions of two unlike sides need it.
    for (const int extra : {0, 1, 2}) {
      const std::array<int, 2> finer = {grid[0] + extra, grid[1] + extra};
      SCOPED_TRACE(::testing::Message() << n[0] << n[1] << n[2] << n[3] << " + " << extra);
      expect_disc(PatchPattern(n, finer));
    }
  }
}

TEST(GltfPattern, EqualSidesGiveQuadsOnly) {
  for (const int columns : {1, 2, 5}) {
    for (const int rows : {1, 3}) {
      const PatchPattern pattern({columns, rows, columns, rows}, {columns, rows});
      EXPECT_EQ(static_cast<int>(pattern.polygons().size()), columns * rows);
      for (const Polygon& p : pattern.polygons()) EXPECT_GE(p[3], 0);
    }
  }
}

TEST(GltfSurface, TrianglesTellTheQuads) {
  PatchMesh patches = testing::random_patches(6, 5, 60, 50, 3, {.curvature = 0});
  testing::set_random_colors(patches, 4);
  const VectorImage image = testing::single_layer(std::move(patches), 60, 50);
  const GltfFile file = written(image);
  const auto places = file.attribute(0, "POSITION");
  std::set<std::set<std::pair<float, float>>> expected, found;
  const QuadMesh& mesh = image.layers[0].patches.mesh;
  for (const auto& quad : mesh.quads()) {
    std::set<std::pair<float, float>> ring;
    for (const int v : quad) {
      const auto p = mesh.vertices[v].cast<float>();
      ring.emplace(p.x(), float(50.0 - p.y()));
    }
    expected.insert(ring);
  }
  for (const auto& polygon : test::polygons(file.triangles(0))) {
    ASSERT_EQ(polygon.size(), 4);
    std::set<std::pair<float, float>> ring;
    for (const auto v : polygon) ring.emplace(float(places[v][0]), float(places[v][1]));
    found.insert(ring);
  }
  EXPECT_EQ(found, expected);
}

TEST(GltfSurface, NoFanJoinsMoreThanAQuad) {
  for (const GltfCompression compression : {GltfCompression::none, GltfCompression::meshopt}) {
    const GltfFile file = written(test::torn_disc(true), {.compression = compression});
    for (std::size_t p = 0; p < file.primitive_count(0); ++p) {
      for (const auto& polygon : test::polygons(file.triangles(static_cast<int>(p)))) {
        EXPECT_LE(polygon.size(), 4);
      }
    }
  }
}

TEST(GltfSurface, StaysWithinTheToleranceOfTheOutlineAndOfTears) {
  const VectorImage image = test::torn_disc(true);
  const SheetedLayer layer(image.layers[0]);
  const GltfFile file = written(image);
  std::vector<Eigen::Vector2d> vertices;
  for (std::size_t p = 0; p < file.primitive_count(0); ++p) {
    for (const auto& place : file.attribute(static_cast<int>(p), "POSITION")) {
      vertices.emplace_back(place[0], 32 - place[1]);
    }
  }
  // Both sides of the tear have the same places on it, dense enough for chords within 0.05 pixels.
  constexpr int kSteps = 2520;  // a multiple of all divisions that come into question
  for (int e = 0; e < layer.mesh().edge_count(); ++e) {
    if (!layer.mesh().is_tear(e)) continue;
    const PlaneCurve curve = layer.edge_curve(e);
    std::vector<double> on_edge;
    for (int k = 0; k <= kSteps; ++k) {
      const Eigen::Vector2d p = sub_curve(curve, double(k) / kSteps, double(k) / kSteps)[0];
      const auto hits = std::count_if(vertices.begin(), vertices.end(),
                                      [&](const auto& v) { return (v - p).norm() < 1e-5; });
      if (hits == 0) continue;
      EXPECT_EQ(hits, 2);
      on_edge.push_back(double(k) / kSteps);
    }
    for (std::size_t i = 1; i < on_edge.size(); ++i) {
      EXPECT_LE(chord_distance(sub_curve(curve, on_edge[i - 1], on_edge[i])), 0.05);
    }
  }
}

TEST(GltfSurface, StaysClosedAcrossTearsInEveryMode) {
  for (const bool is_opaque : {true, false}) {
    for (const GltfColors colors : {GltfColors::texture, GltfColors::vertex}) {
      for (const double relief : {0.0, 12.0}) {
        const GltfFile file =
            written(test::torn_disc(is_opaque), {.colors = colors, .lit = true, .relief = relief});
        int repeated = 0, inside = 0;
        for (const auto& [a, b] : test::open_sides(file, &repeated)) {
          const bool on_border = (a[0] == 0 && b[0] == 0) || (a[1] == 0 && b[1] == 0) ||
                                 (a[0] == 40 && b[0] == 40) || (a[1] == 32 && b[1] == 32);
          inside += !on_border;
        }
        EXPECT_EQ(repeated, 0);
        EXPECT_EQ(inside, 0);
      }
    }
  }
}

TEST(GltfSurface, ReliefReachesFromBlackToWhite) {
  // Brightness rises from 0 at the left to 1 at the right.
  PatchMesh patches = straight_patches(testing::lattice(4, 2, 20, 10));
  testing::set_linear_colors(patches, Color(0, 0, 0, 1), Color(0.05f, 0.05f, 0.05f, 0));
  const VectorImage image = testing::single_layer(std::move(patches), 20, 10);
  for (const double relief : {3.0, -40.0}) {
    for (const auto compression : {GltfCompression::none, GltfCompression::meshopt}) {
      const GltfFile file =
          written(image, {.lit = true, .relief = relief, .compression = compression});
      const auto normals = file.attribute(0, "NORMAL");
      const auto places = file.attribute(0, "POSITION");
      const double tolerance = std::abs(relief) / 65535 + 1e-3;
      for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_NEAR(places[i][2], relief * places[i][0] / 20, tolerance);
        const double length = std::hypot(relief / 20, 1);
        EXPECT_NEAR(normals[i][0], -relief / 20 / length, 1e-3);
        EXPECT_NEAR(normals[i][1], 0, 1e-3);
        EXPECT_NEAR(normals[i][2], 1 / length, 1e-3);
      }
      if (compression != GltfCompression::none) continue;
      const int accessor = file.primitive(0)["attributes"]["POSITION"];
      const auto& bounds = file.gltf["accessors"][accessor];
      EXPECT_NEAR(bounds["max"][2].get<double>() - bounds["min"][2].get<double>(), std::abs(relief),
                  1e-5 * std::abs(relief));
    }
  }
}

TEST(GltfSurface, ReliefAtATearIsTheMeanOfBothSides) {
  testing::SplitMesh split = testing::split_mesh(2, 3, 20, 12, 10, 10);
  testing::tear(split.mesh, split.line);
  PatchMesh patches = straight_patches(std::move(split.mesh));
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    const auto& quad = patches.mesh.quads()[QuadMesh::quad_of(h)];
    double x = 0;
    for (const int v : quad) x += patches.mesh.vertices[v].x() / 4;
    const float grey = x < 10 ? 0.2f : 0.8f;
    patches.wedges[patches.wedge_of_corner[h]].value = Color(grey, grey, grey, 1);
  }
  const GltfFile file = written(testing::single_layer(std::move(patches), 20, 12), {.relief = 10});
  ASSERT_EQ(file.primitive_count(0), 2);
  for (int p = 0; p < 2; ++p) {
    for (const auto& place : file.attribute(p, "POSITION")) {
      EXPECT_NEAR(place[2], place[0] < 10 ? 2 : place[0] > 10 ? 8 : 5, 1e-5);
    }
  }
}

TEST(GltfSurface, VertexColoursAreLinearLight) {
  for (const float alpha : {1.0f, 0.5f}) {
    PatchMesh patches = straight_patches(testing::lattice(1, 1, 4, 4));
    testing::set_linear_colors(patches, Color(0.5f, 0.02f, 1, 1) * alpha);
    patches.opaque = alpha == 1;
    const GltfFile file =
        written(testing::single_layer(std::move(patches), 4, 4), {.colors = GltfColors::vertex});
    EXPECT_FALSE(file.gltf.contains("images"));
    EXPECT_EQ(file.gltf["materials"][0].value("alphaMode", "OPAQUE"),
              alpha == 1 ? "OPAQUE" : "BLEND");
    for (const auto& color : file.attribute(0, "COLOR_0")) {
      EXPECT_NEAR(color[0], 0.214041, 2e-5);  // IEC 61966-2-1 at 1/2
      EXPECT_NEAR(color[1], 0.02 / 12.92, 2e-5);
      EXPECT_NEAR(color[2], 1, 2e-5);
      EXPECT_EQ(color.size(), alpha == 1 ? 3 : 4);
      if (alpha < 1) {
        EXPECT_NEAR(color[3], alpha, 2e-5);
      }
    }
  }
}

TEST(GltfSurface, VertexColoursJumpAtTears) {
  const VectorImage image = test::torn_disc(true);
  const GltfFile file = written(image, {.colors = GltfColors::vertex});
  const auto places = file.attribute(0, "POSITION");
  const auto colors = file.attribute(0, "COLOR_0");
  std::map<test::Place, std::set<std::vector<double>>> at;
  for (std::size_t i = 0; i < places.size(); ++i) at[places[i]].insert(colors[i]);
  const QuadMesh& mesh = image.layers[0].patches.mesh;
  int torn = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    std::set<int> wedges;
    for (const int h : mesh.fan(v)) wedges.insert(image.layers[0].patches.wedge_of_corner[h]);
    const auto p = mesh.vertices[v].cast<float>();
    const test::Place place = {p.x(), double(static_cast<float>(32.0 - p.y())), 0};
    ASSERT_TRUE(at.contains(place));
    EXPECT_EQ(at[place].size(), wedges.size());
    torn += wedges.size() > 1;
  }
  EXPECT_EQ(torn, 12);
}

TEST(GltfSurface, VertexColoursAreFineEnough) {
  PatchMesh patches = testing::random_patches(2, 2, 40, 40, 5);
  testing::set_random_colors(patches, 6);
  const VectorImage image = testing::single_layer(std::move(patches), 40, 40);
  const auto count = [&](GltfColors colors) {
    return written(image, {.colors = colors}).triangles(0).size();
  };
  EXPECT_GT(count(GltfColors::vertex), 2 * count(GltfColors::texture));
}

TEST(GltfSurface, QuantizedPlacesKeepTheirBound) {
  const VectorImage image = test::torn_disc(false);
  for (const GltfColors colors : {GltfColors::texture, GltfColors::vertex}) {
    const GltfOptions options{.colors = colors, .relief = 6};
    const GltfFile exact = written(image, options);
    for (const auto compression : {GltfCompression::quantize, GltfCompression::meshopt}) {
      GltfOptions compressed = options;
      compressed.compression = compression;
      const GltfFile file = written(image, compressed);
      EXPECT_LT(file.bytes.size(), exact.bytes.size());
      ASSERT_EQ(file.primitive_count(0), exact.primitive_count(0));
      for (int p = 0; p < static_cast<int>(file.primitive_count(0)); ++p) {
        EXPECT_EQ(file.triangles(p), exact.triangles(p));
        const auto a = exact.attribute(p, "POSITION"), b = file.attribute(p, "POSITION");
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
          for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[i][c], b[i][c], 40.0 / 131070 + 1e-5);
        }
        if (colors == GltfColors::vertex) continue;
        const auto s = exact.attribute(p, "TEXCOORD_0"), t = file.attribute(p, "TEXCOORD_0");
        for (std::size_t i = 0; i < s.size(); ++i) {
          for (int c = 0; c < 2; ++c) EXPECT_NEAR(s[i][c], t[i][c], 1.0 / 131070 + 1e-6);
        }
      }
    }
  }
}

TEST(GltfSurface, ControlDataAreTheDocumentOfTheLayer) {
  VectorImage image = test::torn_disc(true);
  image.layers.push_back(image.layers[0]);
  image.layers[1].transform = Eigen::Translation2d(3, 4) * Eigen::Scaling(0.5, 0.5);
  const GltfFile file = written(image);
  for (int k = 0; k < 2; ++k) {
    const std::string text = file.gltf["meshes"][k]["extras"]["quadrille_document"];
    std::vector<std::byte> bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
      const auto digit =
          std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
      if (digit == std::string::npos) break;
      bits = bits << 6 | static_cast<std::uint32_t>(digit);
      if ((count += 6) < 8) continue;
      count -= 8;
      bytes.push_back(static_cast<std::byte>(bits >> count & 255));
    }
    const VectorImage read = from_document(bytes);
    ASSERT_EQ(read.layers.size(), 1);
    EXPECT_EQ(read.patch_count(), image.layers[k].patches.patch_count());
    EXPECT_TRUE(read.layers[0].transform.isApprox(image.layers[k].transform, 1e-6));
  }
}

}  // namespace
}  // namespace quadrille
