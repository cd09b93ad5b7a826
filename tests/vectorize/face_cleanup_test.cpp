#include "face_cleanup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "convex_faces.h"
#include "guarded_edit.h"
#include "polygon_divisions.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using Faces = std::vector<std::vector<int>>;

/// The lattice of columns x rows unit squares: points row by row.
struct Lattice {
  int columns, rows;
  std::vector<Vector2d> points;
  Faces faces;

  Lattice(int columns, int rows) : columns(columns), rows(rows) {
    for (int j = 0; j <= rows; ++j) {
      for (int i = 0; i <= columns; ++i) points.emplace_back(i, j);
    }
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  int at(int i, int j) const { return j * (columns + 1) + i; }
  void replace(const std::vector<std::array<int, 2>>& cells, const Faces& by) {
    for (const auto& [i, j] : cells) faces[j * columns + i].clear();
    std::erase_if(faces, [](const auto& face) { return face.empty(); });
    faces.insert(faces.end(), by.begin(), by.end());
  }
};

std::set<std::set<int>> corner_sets(const FaceMesh& mesh) {
  std::set<std::set<int>> all;
  for (int f = 0; f < mesh.face_slots(); ++f) {
    const Face& face = mesh.face(f);
    if (face.size > 0) all.insert({face.vertex.begin(), face.vertex.begin() + face.size});
  }
  return all;
}

std::set<std::set<int>> corner_sets(const Faces& faces) {
  std::set<std::set<int>> all;
  for (const auto& face : faces) all.insert({face.begin(), face.end()});
  return all;
}

/// What the faces lack of a good quality, squared and summed.
/// Sum of the vertices' penalties, plus one for every triangle.
int irregularity(const FaceMesh& mesh) {
  int sum = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.faces_at(v).empty()) sum += mesh.penalty(v, mesh.excess(v));
  }
  for (int f = 0; f < mesh.face_slots(); ++f) sum += mesh.face(f).size == 3;
  return sum;
}

double badness(const FaceMesh& mesh) {
  double sum = 0;
  for (int f = 0; f < mesh.face_slots(); ++f) {
    if (mesh.face(f).size == 0) continue;
    const double lacking = std::max(0.0, 0.5 - face_quality(mesh, mesh.face(f)));
    sum += lacking * lacking;
  }
  return sum;
}

long long binomial(int n, int k) {
  long long value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

TEST(PolygonDivisions, AreAsManyAsTheFussCatalanNumbersSay) {
  for (int quads = 1; 2 * quads + 2 <= kMostDivided; ++quads) {
    EXPECT_EQ(static_cast<long long>(polygon_divisions(2 * quads + 2).size()),
              binomial(3 * quads, quads) / (2 * quads + 1));
  }
  // With a triangle: binomial(3 m + 2, m) for m quads.
  for (int quads = 1; 2 * quads + 3 <= kMostDivided; ++quads) {
    EXPECT_EQ(static_cast<long long>(polygon_divisions(2 * quads + 3).size()),
              binomial(3 * quads + 2, quads));
  }
}

TEST(FaceMesh, CountsTheIrregular) {
  Lattice lattice(4, 4);
  EXPECT_EQ(irregularity(FaceMesh(lattice.points, lattice.faces)), 0);
  const int a = lattice.at(1, 1), b = lattice.at(2, 1), c = lattice.at(2, 2), d = lattice.at(1, 2);
  lattice.replace({{1, 1}}, {{a, b, c}, {a, c, d}});
  const FaceMesh mesh(lattice.points, lattice.faces);
  EXPECT_EQ(irregularity(mesh), 4);  // two triangles, two vertices with a face too many
  EXPECT_EQ(mesh.excess(a), 1);
  EXPECT_EQ(mesh.excess(b), 0);
}

TEST(FaceMesh, EditsAreUndoneByTheirInverse) {
  Lattice lattice(4, 4);
  FaceMesh mesh(lattice.points, lattice.faces);
  FaceEdit edit;
  edit.merged.push_back({lattice.at(1, 1), lattice.at(2, 2)});
  ASSERT_TRUE(mesh.complete_merges(edit));
  const int change = mesh.irregularity_change(edit);
  ASSERT_TRUE(mesh.apply(edit));
  EXPECT_EQ(irregularity(mesh), change);
  ASSERT_TRUE(mesh.apply(edit));
  EXPECT_EQ(irregularity(mesh), 0);
  EXPECT_EQ(corner_sets(mesh), corner_sets(lattice.faces));
}

TEST(FaceMesh, RefusesEditsThatAreNoMesh) {
  Lattice lattice(3, 3);
  FaceMesh mesh(lattice.points, lattice.faces);
  const auto merges = [&](int a, int b) {
    FaceEdit edit;
    edit.merged.push_back({a, b});
    return mesh.complete_merges(edit) && mesh.apply(edit);
  };
  EXPECT_FALSE(merges(lattice.at(0, 1), lattice.at(3, 1)));  // opposite sides
  EXPECT_FALSE(merges(lattice.at(0, 0), lattice.at(0, 3)));  // two corners
  EXPECT_FALSE(merges(lattice.at(1, 0), lattice.at(0, 1)));  // cuts off a corner
  EXPECT_EQ(corner_sets(mesh), corner_sets(lattice.faces));
}

TEST(FaceMesh, SplitsFacesAroundTheirCentres) {
  Lattice lattice(3, 2);
  const int a = lattice.at(1, 0), b = lattice.at(2, 0), c = lattice.at(2, 1), d = lattice.at(1, 1);
  lattice.replace({{1, 0}}, {{a, b, c}, {a, c, d}});
  std::vector<VertexGuide> guides;
  const QuadMesh mesh = FaceMesh(lattice.points, lattice.faces).split(guides);
  EXPECT_EQ(mesh.quad_count(), 5 * 4 + 2 * 3);
  ASSERT_EQ(static_cast<int>(guides.size()), mesh.vertex_count());
  EXPECT_TRUE(validate(mesh, 3, 2).empty());
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vector2d& p = mesh.vertices[v];
    const bool x_held = p.x() == 0 || p.x() == 3, y_held = p.y() == 0 || p.y() == 2;
    EXPECT_EQ(guides[v].kind, x_held && y_held   ? VertexGuide::Kind::fixed
                              : x_held || y_held ? VertexGuide::Kind::line
                                                 : VertexGuide::Kind::free);
  }
}

TEST(CleanUp, LeavesARegularLatticeAlone) {
  const Lattice lattice(5, 4);
  FaceMesh mesh(lattice.points, lattice.faces);
  clean_up(mesh);
  EXPECT_EQ(corner_sets(mesh), corner_sets(lattice.faces));
  EXPECT_EQ(mesh.points, lattice.points);
}

TEST(CleanUp, RotatesAnEdgeBackBetweenThreesAndFives) {
  const Lattice regular(6, 5);
  Lattice lattice = regular;
  const auto at = [&](int i, int j) { return lattice.at(i, j); };
  lattice.replace({{2, 2}, {3, 2}}, {{at(2, 2), at(3, 2), at(4, 2), at(4, 3)},
                                     {at(2, 2), at(4, 3), at(3, 3), at(2, 3)}});
  FaceMesh mesh(lattice.points, lattice.faces);
  ASSERT_EQ(irregularity(mesh), 4);
  FaceMesh kept = mesh;
  clean_up(mesh);
  EXPECT_EQ(corner_sets(mesh), corner_sets(regular.faces));

  kept.keep_edge(at(2, 2), at(4, 3));
  clean_up(kept);
  EXPECT_GE(kept.face_with(at(2, 2), at(4, 3)), 0);
}

TEST(CleanUp, PairsTrianglesThroughAChainOfQuads) {
  for (int quads = 0; quads <= 2; ++quads) {
    const Lattice regular(quads + 5, 5);
    Lattice lattice = regular;
    const auto at = [&](int i, int j) { return lattice.at(i, j); };
    // A row of sheared quads between two triangles.
    Faces sheared{{at(2, 2), at(3, 3), at(2, 3)}};
    std::vector<std::array<int, 2>> cells;
    for (int i = 2; i <= quads + 2; ++i) {
      cells.push_back({i, 2});
      if (i < quads + 2) sheared.push_back({at(i, 2), at(i + 1, 2), at(i + 2, 3), at(i + 1, 3)});
    }
    sheared.push_back({at(quads + 2, 2), at(quads + 3, 2), at(quads + 3, 3)});
    lattice.replace(cells, sheared);
    FaceMesh mesh(lattice.points, lattice.faces);
    ASSERT_EQ(irregularity(mesh), 4) << quads;
    clean_up(mesh);
    EXPECT_EQ(corner_sets(mesh), corner_sets(regular.faces)) << quads;
  }
}

TEST(CleanUp, RemovesADoublet) {
  const Lattice regular(5, 5);
  Lattice lattice = regular;
  const int a = lattice.at(2, 2), b = lattice.at(3, 2), c = lattice.at(3, 3), d = lattice.at(2, 3);
  const int v = static_cast<int>(lattice.points.size());
  lattice.points.emplace_back(2.5, 2.5);
  lattice.replace({{2, 2}}, {{a, b, c, v}, {a, v, c, d}});
  FaceMesh mesh(lattice.points, lattice.faces);
  ASSERT_EQ(irregularity(mesh), 6);
  clean_up(mesh);
  EXPECT_EQ(irregularity(mesh), 0);
  std::vector<VertexGuide> guides;
  EXPECT_TRUE(validate(mesh.split(guides), 5, 5).empty());
}

TEST(CleanUp, CollapsesAQuadBetweenThrees) {
  // An inner vertex pulled apart into u on the left and v on the right, with a quad between.
  Lattice lattice(5, 5);
  const auto at = [&](int i, int j) { return lattice.at(i, j); };
  const int u = at(2, 2), v = static_cast<int>(lattice.points.size());
  lattice.points[u] = {1.7, 2};
  lattice.points.emplace_back(2.3, 2);
  lattice.replace({{2, 1}, {2, 2}}, {{at(2, 1), at(3, 1), at(3, 2), v},
                                     {v, at(3, 2), at(3, 3), at(2, 3)},
                                     {u, at(2, 1), v, at(2, 3)}});
  FaceMesh mesh(lattice.points, lattice.faces);
  ASSERT_EQ(irregularity(mesh), 4);
  clean_up(mesh);
  EXPECT_EQ(irregularity(mesh), 0);
  EXPECT_EQ(corner_sets(mesh).size(), 25u);
}

/// Points on a jittered lattice, some missing, with their constrained Delaunay triangulation.
FaceMesh random_faces(testing::Random& random, double& width, double& height) {
  constexpr std::int64_t kUnit = 1024;
  const int columns = random.integer(1, 14), rows = random.integer(1, 14);
  const double jitter = random.uniform(0, 0.45), missing = random.uniform(0, 0.3);
  width = columns, height = rows;
  Triangulation triangulation(columns * kUnit, rows * kUnit);
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      if (random.uniform() < missing) continue;
      const auto moved = [&](int at, int last) {
        return at == 0 || at == last
                   ? at * kUnit
                   : static_cast<std::int64_t>(kUnit * (at + random.uniform(-jitter, jitter)));
      };
      triangulation.insert({moved(i, columns), moved(j, rows)});
    }
  }
  std::vector<Vector2d> points;
  for (const GridPoint& p : triangulation.points()) {
    points.emplace_back(static_cast<double>(p.x) / kUnit, static_cast<double>(p.y) / kUnit);
  }
  return FaceMesh(std::move(points), convex_faces(triangulation));
}

TEST(CleanUp, KeepsRandomMeshesValidAndMakesThemMoreRegular) {
  testing::Random random(11);
  long long before = 0, after = 0;
  for (int i = 0; i < 150; ++i) {
    double width = 0, height = 0;
    FaceMesh mesh = random_faces(random, width, height);
    const int start = irregularity(mesh);
    const double bad = badness(mesh);
    clean_up(mesh);
    EXPECT_LE(irregularity(mesh), start);
    EXPECT_LE(badness(mesh), bad + 1e-9) << i;
    before += start, after += irregularity(mesh);
    std::vector<VertexGuide> guides;
    const auto violations = validate(mesh.split(guides), width, height);
    EXPECT_TRUE(violations.empty()) << i << ": " << violations.front().what;
  }
  EXPECT_LT(after, 0.6 * before);
}

TEST(CleanUp, NeverRemovesKeptEdges) {
  testing::Random random(12);
  for (int i = 0; i < 40; ++i) {
    double width = 0, height = 0;
    FaceMesh mesh = random_faces(random, width, height);
    std::vector<std::array<int, 2>> kept;
    for (int f = 0; f < mesh.face_slots(); ++f) {
      const Face& face = mesh.face(f);
      if (random.uniform() < 0.2 && face.size > 0) kept.push_back({face[0], face[1]});
    }
    for (const auto& [a, b] : kept) mesh.keep_edge(a, b);
    clean_up(mesh);
    for (const auto& [a, b] : kept) {
      EXPECT_TRUE(mesh.face_with(a, b) >= 0 || mesh.face_with(b, a) >= 0) << i;
    }
  }
}

}  // namespace
}  // namespace quadrille
