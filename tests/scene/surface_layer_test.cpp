#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "quadrille/error.h"
#include "quadrille/picture_layers.h"
#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

const SceneShapes& shapes_of(const SceneLayer& layer) {
  return std::get<SceneShapes>(layer.content);
}

template <class T>
const std::vector<T>& values(const std::vector<SceneArray>& arrays, const std::string& name) {
  const auto array = std::ranges::find(arrays, name, &SceneArray::name);
  EXPECT_NE(array, arrays.end()) << name;
  return std::get<std::vector<T>>(array->values);
}

VectorImage random_picture(bool opaque = true) {
  PatchMesh patches = testing::random_patches(5, 4, 53, 37, 11);
  testing::set_random_colors(patches, 12, opaque);
  return single_layer(std::move(patches), 53, 37);
}

double cell_area(const SceneShapes& shapes, int c) {
  double area = 0;
  const int begin = shapes.cell_begin[c], end = shapes.cell_begin[c + 1];
  for (int k = begin; k < end; ++k) {
    const Vector2d& a = shapes.points[shapes.cell_points[k]];
    const Vector2d& b = shapes.points[shapes.cell_points[k + 1 < end ? k + 1 : begin]];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

class Surface : public ::testing::TestWithParam<int> {};

TEST_P(Surface, SharesThePointsOfEdgesAndCoversThePicture) {
  const VectorImage image = random_picture();
  const QuadMesh& mesh = image.layers[0].patches.mesh;
  const int n = GetParam();
  const SceneLayer layer = surface_layer(image, n);
  const SceneShapes& shapes = shapes_of(layer);
  EXPECT_EQ(shapes.cell_count(), mesh.quad_count() * n * n);
  EXPECT_EQ(shapes.points.size(), mesh.vertex_count() + mesh.edge_count() * (n - 1) +
                                      mesh.quad_count() * (n - 1) * (n - 1));
  double area = 0;
  for (int c = 0; c < shapes.cell_count(); ++c) area += cell_area(shapes, c);
  EXPECT_NEAR(area, 53 * 37, 1e-8);  // the border is straight and there are no cracks
}

TEST_P(Surface, LiesOnThePatchesWithTheirColours) {
  const VectorImage image = random_picture(false);
  const PatchMesh& patches = image.layers[0].patches;
  const int n = GetParam();
  const SceneLayer layer = surface_layer(image, n);
  const SceneShapes& shapes = shapes_of(layer);
  const auto& color = values<float>(shapes.point_arrays, "color_premultiplied");
  const auto& patch_of = values<std::int32_t>(shapes.cell_arrays, "patch");
  for (int c = 0; c < shapes.cell_count(); ++c) {
    const int q = c / (n * n), i = c % n, j = c / n % n;
    EXPECT_EQ(patch_of[c], q);
    const FergusonPatch patch = ferguson_patch(patches, q);
    const int point = shapes.cell_points[shapes.cell_begin[c]];
    const double u = double(i) / n, v = double(j) / n;
    EXPECT_LT((shapes.points[point] - patch.position.at(u, v)).norm(), 1e-10);
    const Color expected = patch.color.at(u, v);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(color[4 * point + k], expected[k], 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Divisions, Surface, ::testing::Values(1, 2, 4, 7));

TEST(TornSurface, HasPointsOnBothSidesAtTheSamePlaces) {
  auto split = testing::split_mesh(4, 3, 40, 30, 18, 22);
  testing::tear(split.mesh, split.line);
  const int vertices = split.mesh.vertex_count(), edges = split.mesh.edge_count();
  const int quads = split.mesh.quad_count(), torn = static_cast<int>(split.line.size());
  const VectorImage image = single_layer(straight_patches(std::move(split.mesh)), 40, 30);
  const SceneLayer layer = surface_layer(image, 4);
  const SceneShapes& shapes = shapes_of(layer);
  const int whole = vertices + 3 * edges + 9 * quads;
  EXPECT_EQ(shapes.points.size(), whole + (torn + 1) + 3 * torn);
  std::map<std::pair<double, double>, int> places;
  for (const Vector2d& p : shapes.points) ++places[{p.x(), p.y()}];
  EXPECT_EQ(places.size(), whole);
  const auto& region = values<std::int32_t>(shapes.cell_arrays, "region");
  EXPECT_EQ(*std::ranges::max_element(region), 1);
}

TEST(MirroredSurface, KeepsItsOrientation) {
  VectorImage image = random_picture();
  image.layers[0].transform = Eigen::Translation2d(53, 0) * Eigen::Scaling(-1.0, 1.0);
  const SceneLayer layer = surface_layer(image, 2);
  for (int c = 0; c < shapes_of(layer).cell_count(); ++c) {
    EXPECT_GT(cell_area(shapes_of(layer), c), 0);
  }
}

TEST(SurfaceDivisions, OutOfRangeAreRefused) {
  for (const int divisions : {0, 65}) {
    try {
      surface_layer(random_picture(), divisions);
      FAIL() << divisions;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
    }
  }
}

TEST(ControlNet, HoldsEveryControlPointOnce) {
  const VectorImage image = random_picture();
  const PatchMesh& patches = image.layers[0].patches;
  const SceneLayer layer = control_net_layer(image);
  const SceneShapes& shapes = shapes_of(layer);
  EXPECT_EQ(shapes.points.size(), patches.mesh.vertex_count() + 2 * patches.mesh.edge_count() +
                                      4 * patches.mesh.quad_count());
  ASSERT_EQ(shapes.cell_count(), patches.mesh.edge_count() + 4 * patches.mesh.quad_count());
  for (int q = 0; q < patches.patch_count(); ++q) {
    const auto net = bezier_patch(patches, q).position.control;
    const int first = patches.mesh.edge_count() + 4 * q;
    for (int k = 0; k < 2; ++k) {
      for (int i = 0; i < 4; ++i) {
        const auto& points = shapes.cell_points;
        const Vector2d& in_row = shapes.points[points[shapes.cell_begin[first + 2 * k] + i]];
        const Vector2d& in_column = shapes.points[points[shapes.cell_begin[first + 2 * k + 1] + i]];
        EXPECT_LT((in_row - net[k + 1][i]).norm(), 1e-12);
        EXPECT_LT((in_column - net[i][k + 1]).norm(), 1e-12);
      }
    }
  }
}

TEST(EdgeLayers, TellTearsFromOtherEdges) {
  auto split = testing::split_mesh(4, 3, 40, 30, 18, 22);
  testing::tear(split.mesh, split.line);
  const int edges = split.mesh.edge_count(), torn = static_cast<int>(split.line.size());
  const VectorImage image = single_layer(straight_patches(std::move(split.mesh)), 40, 30);
  EXPECT_EQ(shapes_of(tear_layer(image)).cell_count(), torn);
  const SceneLayer all = edge_layer(image);
  EXPECT_EQ(shapes_of(all).cell_count(), edges);
  const auto& flags = values<std::uint8_t>(shapes_of(all).cell_arrays, "tear");
  EXPECT_EQ(std::ranges::count(flags, 1), torn);
}

TEST(IrregularVertices, AreThoseOfTheMesh) {
  const auto disc = testing::disc_mesh(3, 1, 2, 40, 40, {20, 20}, 10);
  const SceneLayer layer = irregular_vertex_layer(disc.mesh);
  const auto& valence = values<std::int32_t>(shapes_of(layer).point_arrays, "valence");
  const auto& vertex = values<std::int32_t>(shapes_of(layer).point_arrays, "vertex");
  std::vector<int> expected;
  for (int v = 0; v < disc.mesh.vertex_count(); ++v) {
    if (!disc.mesh.is_border_vertex(v) && disc.mesh.valence(v) != 4) expected.push_back(v);
  }
  EXPECT_EQ(vertex, expected);
  for (std::size_t i = 0; i < vertex.size(); ++i) {
    EXPECT_EQ(valence[i], disc.mesh.valence(vertex[i]));
  }
}

}  // namespace
}  // namespace quadrille
