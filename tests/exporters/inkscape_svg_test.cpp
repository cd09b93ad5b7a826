#include "inkscape_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "inkscape_mesh.h"
#include "inkscape_slopes.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "support/programs.h"
#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;

const Color kBase(0.1f, 0.9f, 0.3f, 1);
const Color kAlongX(0.008f, -0.004f, 0, 0), kAlongY(0, -0.006f, 0.004f, 0);

Color linear_color(const Vector2d& p) {
  const Color color = kBase + kAlongX * float(p.x()) + kAlongY * float(p.y());
  return color.cwiseMax(0.0f).cwiseMin(1.0f);
}

VectorImage linear_picture(int columns, int rows) {
  PatchMesh patches = testing::random_patches(columns, rows, 100, 80, 3);
  testing::set_linear_colors(patches, kBase, kAlongX, kAlongY);
  return testing::single_layer(std::move(patches), 100, 80);
}

std::vector<InkscapeMesh> meshes_of(const VectorImage& image, double bleed, double tolerance) {
  const Layer& layer = image.layers.front();
  const QuadMesh& mesh = layer.patches.mesh;
  std::vector<InkscapeMesh> meshes;
  for (const QuadGrid& grid :
       regular_grids(mesh, std::vector<unsigned char>(mesh.quad_count(), 1))) {
    meshes.push_back(inkscape_mesh(PlacedGrid(layer, grid), bleed, tolerance));
  }
  return meshes;
}

std::string svg_of(const VectorImage& image, const std::string& title = "picture") {
  std::ostringstream out;
  write_inkscape_svg(out, image, title, {});
  return out.str();
}

/// What `script` prints of the file as an XML tree `root`.
std::string told_by_python(const std::string& svg, const std::string& script) {
  const std::filesystem::path path = test::scratch_dir() / "mesh.svg";
  std::ofstream(path) << svg;
  std::string said;
  EXPECT_EQ(test::run({"python3", "-c",
                       "import sys, xml.etree.ElementTree as t\n"
                       "root = t.parse(sys.argv[1]).getroot()\n"
                       "s = '{http://www.w3.org/2000/svg}'\n" +
                           script,
                       path},
                      &said),
            0)
      << said;
  return said;
}

void expect_sides_join_nodes(const InkscapeMesh& mesh) {
  for (int j = 0; j <= mesh.rows; ++j) {
    for (int i = 0; i < mesh.columns; ++i) {
      const PlaneCurve& side = mesh.across[mesh.side_across(i, j)];
      EXPECT_LT((side[0] - mesh.nodes[mesh.node(i, j)]).norm(), 1e-9);
      EXPECT_LT((side[3] - mesh.nodes[mesh.node(i + 1, j)]).norm(), 1e-9);
    }
  }
  for (int j = 0; j < mesh.rows; ++j) {
    for (int i = 0; i <= mesh.columns; ++i) {
      const PlaneCurve& side = mesh.down[mesh.side_down(i, j)];
      EXPECT_LT((side[0] - mesh.nodes[mesh.node(i, j)]).norm(), 1e-9);
      EXPECT_LT((side[3] - mesh.nodes[mesh.node(i, j + 1)]).norm(), 1e-9);
    }
  }
}

TEST(InkscapeMesh, SidesJoinTheNodesAndReachBeyondTheGrid) {
  constexpr double kBleed = 1.5;
  for (const int rows : {1, 6}) {
    const std::vector<InkscapeMesh> meshes = meshes_of(linear_picture(8, rows), kBleed, 8);
    ASSERT_EQ(meshes.size(), 1u);
    const InkscapeMesh& mesh = meshes[0];
    EXPECT_EQ(mesh.bicubic, rows > 1);
    expect_sides_join_nodes(mesh);
    Eigen::AlignedBox2d bounds;
    for (const Vector2d& p : mesh.nodes) bounds.extend(p);
    EXPECT_LT(bounds.min().maxCoeff(), -0.7 * kBleed);
    EXPECT_GT((bounds.max() - Vector2d(100, 80)).minCoeff(), 0.7 * kBleed);
  }
}

TEST(InkscapeMesh, NodesOfALatticeLieOnItAndHaveItsColors) {
  PatchMesh patches = straight_patches(testing::lattice(5, 4, 100, 80));
  testing::set_linear_colors(patches, kBase, kAlongX, kAlongY);
  const VectorImage image = testing::single_layer(std::move(patches), 100, 80);
  const InkscapeMesh mesh = meshes_of(image, 2, 8).at(0);
  ASSERT_EQ(std::minmax(mesh.columns, mesh.rows), std::minmax(5, 4));
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vector2d& p = mesh.nodes[i];
    for (int axis = 0; axis < 2; ++axis) {
      const double end = axis == 0 ? 100 : 80;
      const bool prolonged = p[axis] < 0 || p[axis] > end;
      const double on_lattice =
          prolonged ? (p[axis] < 0 ? -2 : end + 2) : 20 * std::round(p[axis] / 20);
      EXPECT_NEAR(p[axis], on_lattice, 1e-6);
    }
    EXPECT_LT((mesh.colors[i] - linear_color(p)).abs().maxCoeff(), 1e-5);
  }
}

TEST(InkscapeMesh, ShortPatchesGetARowMoreInsteadOfBeingProlonged) {
  PatchMesh patches = straight_patches(testing::lattice(5, 40, 100, 80));
  testing::set_linear_colors(patches, kBase);
  const VectorImage image = testing::single_layer(std::move(patches), 100, 80);
  int patch_count = 0;
  for (const InkscapeMesh& mesh : meshes_of(image, 1.5, 8)) patch_count += mesh.columns * mesh.rows;
  // Two grids of 32 and 8 rows of 2 pixels, each with a row more at both ends.
  EXPECT_EQ(patch_count, 5 * (32 + 2) + 5 * (8 + 2));
}

TEST(InkscapeSlopes, ParabolasAreExactAndExtremesFlat) {
  NodeLine parabola, peak;
  for (const int x : {0, 1, 2, 3}) {
    parabola.add(Vector2d(10 * x, 0), Color::Constant(0.02f + 0.1f * x * x));
    peak.add(Vector2d(10 * x, 0), Color::Constant(x == 1 ? 0.5f : 0.2f));
  }
  const std::vector<Color> slopes = parabola.slopes();
  for (int i = 0; i < 3; ++i) {
    for (const double t : {0.0, 0.3, 0.5, 1.0}) {
      EXPECT_NEAR(parabola.between(i, t, slopes)[0], 0.02 + 0.1 * (i + t) * (i + t), 1e-5);
    }
  }
  EXPECT_EQ(peak.slopes()[1][0], 0);
}

TEST(InkscapeSvg, IsWellFormedAndHasAPathForEveryMesh) {
  testing::SplitMesh split = testing::split_mesh(8, 6, 80, 60, 30, 50);
  testing::tear(split.mesh, split.line);
  const VectorImage image = testing::single_layer(straight_patches(std::move(split.mesh)), 80, 60);
  const std::string svg = svg_of(image, "Cats & <dogs>");
  EXPECT_THAT(svg, HasSubstr("<title>Cats &amp; &lt;dogs&gt;</title>"));
  EXPECT_EQ(
      told_by_python(svg,
                     "for g, p in zip(root.iter(s + 'meshgradient'), root.iter(s + 'path')):\n"
                     "  assert p.get('fill').startswith('url(#' + g.get('id') + ') #')\n"
                     "  rows = [[len(patch) for patch in row] for row in g]\n"
                     "  print(g.get('type'), rows[0] == [4, 3, 3, 3], rows[1:] == "
                     "5 * [[3, 2, 2, 2]])\n"),
      "bicubic True True\nbicubic True True\n");
}

TEST(InkscapeSvg, LeavesOutWhatIsNotFiniteOrTooFar) {
  for (const double far : {std::nan(""), HUGE_VAL, 1e300, -1e9}) {
    PatchMesh patches = straight_patches(testing::lattice(4, 4, 80, 60));
    patches.mesh.vertices[12] = Eigen::Vector2d(far, far);
    const std::string svg = svg_of(testing::single_layer(std::move(patches), 80, 60), "far");
    EXPECT_EQ(told_by_python(svg,
                             "n = [float(t) for m in root.iter(s + 'meshgradient')\n"
                             "     for e in m.iter(s + 'stop')\n"
                             "     for t in e.get('path').replace('C', ' ').split()]\n"
                             "print(len(n) > 0, max(abs(t) for t in n) < 1000)\n"),
              "True True\n");
  }
}

TEST(InkscapeSvg, ColorsAreGivenOnceForEveryNode) {
  const std::string svg = svg_of(linear_picture(5, 4));
  EXPECT_EQ(told_by_python(svg,
                           "g, = root.iter(s + 'meshgradient')\n"
                           "rows, columns = len(g), len(g[0])\n"
                           "stops = list(g.iter(s + 'stop'))\n"
                           "print(sum('stop-color' in x.attrib for x in stops) == "
                           "(rows + 1) * (columns + 1), all('path' in x.attrib for x in stops))\n"),
            "True True\n");
}

TEST(InkscapeSvg, AlphaBecomesStopOpacityAndWhatIsTransparentIsLeftOut) {
  PatchMesh patches = straight_patches(testing::lattice(6, 4, 60, 40));
  testing::set_linear_colors(patches, Color(0.1f, 0.2f, 0.3f, 0.5f));
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    const double x = patches.mesh.vertices[patches.mesh.origin(h)].x();
    if (x > 25) patches.wedges[patches.wedge_of_corner[h]].value = Color::Zero();
  }
  patches.opaque = false;
  const std::string svg = svg_of(testing::single_layer(std::move(patches), 60, 40));
  EXPECT_THAT(svg, HasSubstr("stop-color=\"#336699\" stop-opacity=\".5\""));
  EXPECT_EQ(told_by_python(svg,
                           "import re\n"
                           "print(max(float(x) for p in root.iter(s + 'path') for x in "
                           "re.findall(r'[ML]([\\d.]+) ', p.get('d'))))\n"),
            "30.0\n");
}

TEST(InkscapeSvg, IsALevelOfSvgFiles) {
  const std::filesystem::path path = test::scratch_dir() / "level.svg";
  SvgOptions options;
  options.level = SvgLevel::inkscape;
  options.title = "level";
  const VectorImage image = linear_picture(4, 3);
  write_svg(image, path, options);
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), svg_of(image, "level"));
}

TEST(InkscapeSvg, ProgressOnlyGrowsOverAllLayers) {
  VectorImage image = linear_picture(40, 30);
  image.layers.push_back(linear_picture(20, 20).layers[0]);
  std::vector<double> told;
  RunContext context;
  context.on_progress = [&](const std::string&, double fraction) {
    told.push_back(fraction);
    return true;
  };
  std::ostringstream out;
  write_inkscape_svg(out, image, "", context);
  EXPECT_GT(told.size(), 4u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1);
}

TEST(InkscapeSvg, CanBeCancelled) {
  RunContext context;
  context.on_progress = [](const std::string&, double) { return false; };
  std::ostringstream out;
  EXPECT_THROW(write_inkscape_svg(out, linear_picture(4, 3), "", context), Error);
}

}  // namespace
}  // namespace quadrille
