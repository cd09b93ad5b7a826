#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "quadrille/error.h"
#include "quadrille/export.h"
#include "support/programs.h"
#include "support/python_with_vtk.h"
#include "support/random_patches.h"
#include "vtk_display_colors.h"
#include "vtk_points.h"

namespace quadrille {
namespace {

using nlohmann::json;

constexpr int kBezierQuadrilateral = 77;

/// The parameters (r, s) of a Bezier quadrilateral's 16 points in steps of 1/3, from VTK's manual.
constexpr int kVtkOrder[16][2] = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 0}, {2, 0}, {3, 1}, {3, 2},
                                  {1, 3}, {2, 3}, {0, 1}, {0, 2}, {1, 1}, {2, 1}, {1, 2}, {2, 2}};

std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

VectorImage random_picture(int columns, int rows, double width, double height, bool opaque) {
  PatchMesh patches = testing::random_patches(columns, rows, width, height, 11);
  testing::set_random_colors(patches, 12, opaque);
  return testing::single_layer(std::move(patches), width, height);
}

class VtkFile : public ::testing::Test {
 protected:
  /// Writes the picture and reads it back with VTK.
  json read_back(const VectorImage& image, const VtkOptions& options = {}) {
    const auto path = test::scratch_dir() / "picture.vtu";
    write_vtu(image, path, options);
    EXPECT_FALSE(test::python_with_vtk().empty()) << "no python3 with VTK; install python3-vtk9";
    const std::string script = QUADRILLE_SOURCE_DIR "/tests/programs/read_vtu.py";
    std::string output;
    const int status = test::run({test::python_with_vtk(), script, path.string()}, &output);
    EXPECT_EQ(status, 0) << output;
    return status == 0 ? json::parse(output) : json();
  }
};

TEST_F(VtkFile, HoldsTheControlPointsOfEveryPatchToTheLastBit) {
  const VectorImage image = random_picture(5, 4, 53, 37, true);
  const PatchMesh& patches = image.layers[0].patches;
  const json file = read_back(image);
  EXPECT_EQ(file["types"], json::array({kBezierQuadrilateral}));
  EXPECT_EQ(file["point_type"], "double");
  ASSERT_EQ(file["cells"].size(), patches.patch_count());
  const json& color = file["point_arrays"]["color"];
  EXPECT_EQ(color["type"], "float");
  EXPECT_EQ(color["components"], 3);
  for (int q = 0; q < patches.patch_count(); ++q) {
    const BezierPatch patch = bezier_patch(patches, q);
    ASSERT_EQ(file["cells"][q].size(), 16);
    for (int k = 0; k < 16; ++k) {
      const int point = file["cells"][q][k];
      const auto [r, s] = kVtkOrder[k];
      const Eigen::Vector2d& p = patch.position.control[r][s];
      EXPECT_EQ(file["points"][point], json({p.x(), image.height - p.y(), 0.0})) << q << ", " << k;
      const Color& c = patch.color.control[r][s];
      EXPECT_EQ(color["values"][point], json({c[0], c[1], c[2]})) << q << ", " << k;
    }
  }
}

TEST_F(VtkFile, IsInterpolatedByVtkAsByUs) {
  const VectorImage image = random_picture(4, 3, 40, 24, true);
  const json file = read_back(image);
  for (int q = 0; q < image.patch_count(); ++q) {
    const FergusonPatch patch = ferguson_patch(image.layers[0].patches, q);
    for (const json& sample : file["samples"][q]) {
      const double v = sample["r"], u = sample["s"];
      const Eigen::Vector2d p = patch.position.at(u, v);
      EXPECT_NEAR(sample["position"][0], p.x(), 1e-10);
      EXPECT_NEAR(sample["position"][1], image.height - p.y(), 1e-10);
      const Color c = patch.color.at(u, v);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(sample["values"]["color"][k], c[k], 1e-5);
    }
  }
}

TEST_F(VtkFile, CellsAreCounterClockwiseAndShareTheirEdges) {
  const VectorImage image = random_picture(5, 4, 53, 37, true);
  const QuadMesh& mesh = image.layers[0].patches.mesh;
  const json file = read_back(image);
  EXPECT_EQ(file["points"].size(),
            mesh.vertex_count() + 2 * mesh.edge_count() + 4 * mesh.quad_count());
  for (const json& cell : file["cells"]) {
    double area = 0;
    for (int k = 0; k < 4; ++k) {
      const json& a = file["points"][cell[k].get<int>()];
      const json& b = file["points"][cell[(k + 1) % 4].get<int>()];
      area += a[0].get<double>() * b[1].get<double>() - a[1].get<double>() * b[0].get<double>();
    }
    EXPECT_GT(area, 0);
  }
}

TEST_F(VtkFile, TearsSeparateThePointsOfTheirTwoSides) {
  // The two edges x = 2 of a lattice of 4 x 2 quads are torn, from border to border.
  QuadMesh mesh = testing::lattice(4, 2, 4, 2);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    const bool torn = mesh.vertices[mesh.origin(h)].x() == 2 && mesh.vertices[mesh.tip(h)].x() == 2;
    if (torn) mesh.edge_flags[e] |= kTearEdge;
  }
  const int whole = mesh.vertex_count() + 2 * mesh.edge_count() + 4 * mesh.quad_count();
  const json file = read_back(testing::single_layer(straight_patches(std::move(mesh)), 4, 2));
  const int three_vertices = 3, four_edge_points = 4;
  EXPECT_EQ(file["points"].size(), whole + three_vertices + four_edge_points);
}

TEST_F(VtkFile, ShowsBytesAndPatchQuality) {
  PatchMesh patches = straight_patches(testing::lattice(2, 2, 6, 4));
  testing::set_linear_colors(patches, Color(0.2f, 0.5f, 0, 1), Color(0.1f, 0, 0, 0));
  const json file = read_back(testing::single_layer(std::move(patches), 6, 4));
  EXPECT_EQ(file["active_scalars"], "rgba");
  const json& rgba = file["point_arrays"]["rgba"];
  EXPECT_EQ(rgba["type"], "unsigned char");
  for (std::size_t i = 0; i < rgba["values"].size(); ++i) {
    const double red = 0.2 + 0.1 * file["points"][i][0].get<double>();
    EXPECT_NEAR(rgba["values"][i][0], red * 255, 0.5 + 1e-4);
    EXPECT_EQ(rgba["values"][i][1], 128.0);
    EXPECT_EQ(rgba["values"][i][2], 0.0);
    EXPECT_EQ(rgba["values"][i][3], 255.0);
  }
  const json& cells = file["cell_arrays"];
  EXPECT_EQ(cells["patch"]["values"], json::parse("[[0.0],[1.0],[2.0],[3.0]]"));
  EXPECT_EQ(cells["layer"]["values"], json::parse("[[0.0],[0.0],[0.0],[0.0]]"));
  for (const json& quality : cells["scaled_jacobian"]["values"]) EXPECT_EQ(quality[0], 1.0);
  EXPECT_EQ(cells["region"]["values"], json::parse("[[0.0],[0.0],[0.0],[0.0]]"));
  EXPECT_FALSE(cells.contains("fitting_error"));
  EXPECT_EQ(file["field_arrays"]["picture_size"]["values"], json::parse("[[6.0,4.0]]"));
  EXPECT_FALSE(file["field_arrays"]["conventions"]["values"][0].get<std::string>().empty());
}

/// Root mean square difference between the patches of these control values and the picture shown,
/// red, green and blue, 0 to 255.
double display_error(const PatchMesh& patches, const ControlPoints& points,
                     const std::vector<std::array<std::uint8_t, 4>>& bytes) {
  double sum = 0;
  long long count = 0;
  for (int q = 0; q < patches.patch_count(); ++q) {
    BezierPatch patch = bezier_patch(patches, q);
    BezierPatch drawn = patch;
    for (int k = 0; k < 16; ++k) {
      const auto& c = bytes[points.cells[q][k]];
      const auto [r, s] = kVtkOrder[k];
      drawn.color.control[r][s] = Color(c[0], c[1], c[2], c[3]) / 255;
    }
    for (int i = 0; i < 100; ++i) {
      const double u = (i % 10 + 0.5) / 10, v = (i / 10 + 0.5) / 10;
      const Color shown = patch.color.at(u, v).cwiseMax(0).cwiseMin(1);
      sum += (255 * (drawn.color.at(u, v) - shown)).head<3>().square().sum();
      count += 3;
    }
  }
  return std::sqrt(sum / count);
}

TEST(VtkDisplayColors, ComeNearerToThePictureThanClampedControlValues) {
  PatchMesh patches = testing::random_patches(6, 5, 60, 50, 3);
  testing::set_random_colors(patches, 4);
  for (Wedge& w : patches.wedges) w.dx *= 3, w.dy *= 3;  // control values far outside 0..1
  const VectorImage image = testing::single_layer(patches, 60, 50);
  const ControlPoints points = control_points(image.layers[0], 50);
  std::vector<std::array<std::uint8_t, 4>> clamped;
  for (const Color& c : points.color) {
    auto& bytes = clamped.emplace_back();
    for (int k = 0; k < 4; ++k) bytes[k] = std::lround(std::clamp(c[k], 0.0f, 1.0f) * 255);
  }
  const double fitted_error = display_error(patches, points, display_colors(points));
  EXPECT_LT(fitted_error, 0.7 * display_error(patches, points, clamped));
}

TEST_F(VtkFile, NamesPremultipliedColoursAndShowsStraightOnes) {
  PatchMesh patches = straight_patches(testing::lattice(1, 1, 6, 4));
  testing::set_linear_colors(patches, Color(0.5f, 0.25f, 0, 0.5f));
  const json file = read_back(testing::single_layer(std::move(patches), 6, 4));
  EXPECT_FALSE(file["point_arrays"].contains("color"));
  for (const json& c : file["point_arrays"]["color_premultiplied"]["values"]) {
    EXPECT_EQ(c, json({0.5, 0.25, 0.0, 0.5}));
  }
  for (const json& c : file["point_arrays"]["rgba"]["values"]) {
    EXPECT_EQ(c, json({255.0, 128.0, 0.0, 128.0}));
  }
}

TEST_F(VtkFile, StacksTransformedLayersAndKeepsMirroredOnesCounterClockwise) {
  VectorImage image = random_picture(2, 2, 20, 10, true);
  image.layers.push_back(image.layers[0]);
  image.layers[1].transform = Eigen::Translation2d(20, 0) * Eigen::Scaling(-1.0, 1.0);
  const json file = read_back(image);
  ASSERT_EQ(file["cells"].size(), 8);
  for (std::size_t q = 0; q < 8; ++q) {
    double area = 0;
    for (int k = 0; k < 4; ++k) {
      const json& a = file["points"][file["cells"][q][k].get<int>()];
      const json& b = file["points"][file["cells"][q][(k + 1) % 4].get<int>()];
      area += a[0].get<double>() * b[1].get<double>() - a[1].get<double>() * b[0].get<double>();
      EXPECT_EQ(a[2], q < 4 ? 0.0 : 1.0);
    }
    EXPECT_GT(area, 0) << q;
    EXPECT_EQ(file["cell_arrays"]["layer"]["values"][q][0], q < 4 ? 0.0 : 1.0);
  }
}

TEST_F(VtkFile, TellsTheValenceAtTheCornersOfItsCells) {
  for (const bool mirrored : {false, true}) {
    VectorImage image = random_picture(3, 3, 30, 30, true);
    if (mirrored) {
      image.layers[0].transform = Eigen::Translation2d(30, 0) * Eigen::Scaling(-1.0, 1.0);
    }
    const json file = read_back(image);
    const auto on_side = [](double x) { return x < 1e-9 || x > 30 - 1e-9; };
    for (std::size_t c = 0; c < file["cells"].size(); ++c) {
      for (int k = 0; k < 4; ++k) {
        const json& p = file["points"][file["cells"][c][k].get<int>()];
        const int sides = on_side(p[0]) + on_side(p[1]);
        EXPECT_EQ(file["cell_arrays"]["valence"]["values"][c][k], 4 - sides);
      }
    }
  }
}

TEST_F(VtkFile, HoldsTheErrorsThatItIsGiven) {
  VtkOptions options;
  options.patch_errors = {1.5f, 2.25f};
  const VectorImage image = random_picture(2, 1, 20, 10, true);
  const json file = read_back(image, options);
  EXPECT_EQ(file["cell_arrays"]["fitting_error"]["values"], json::parse("[[1.5],[2.25]]"));
  options.patch_errors.pop_back();
  EXPECT_THROW(write_vtu(image, test::scratch_dir() / "wrong.vtu", options), Error);
}

TEST(Vtk, WritesTheSameBytesAgain) {
  const VectorImage image = random_picture(6, 5, 60, 50, false);
  const auto a = test::scratch_dir() / "a.vtu", b = test::scratch_dir() / "b.vtu";
  RunContext one, three;
  one.threads = 1;
  three.threads = 3;
  write_vtu(image, a, {}, one);
  write_vtu(image, b, {}, three);
  EXPECT_EQ(file_bytes(a), file_bytes(b));
}

TEST(Vtk, SaysThatAFolderIsMissing) {
  try {
    write_vtu(random_picture(1, 1, 6, 4, true), test::scratch_dir() / "absent" / "picture.vtu");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::io_failure);
  }
}

}  // namespace
}  // namespace quadrille
