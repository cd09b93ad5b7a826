#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "quadrille/error.h"
#include "quadrille/export.h"
#include "support/programs.h"
#include "support/random_patches.h"
#include "support/torn_meshes.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

fs::path output(const std::string& name) { return test::scratch_dir() / name; }

/// Writes the picture; the file must be XML that librsvg draws, without any number that is none.
void expect_readable(const VectorImage& image, const std::string& name,
                     const SvgOptions& options = {}) {
  const fs::path svg = output(name + ".svg"), png = output(name + ".png");
  write_svg(image, svg, options);
  std::ifstream file(svg, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const char* word : {"nan", "inf"}) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      const char before = text[at - 1];
      EXPECT_TRUE(std::isalpha(static_cast<unsigned char>(before)) || before == '#' ||
                  before == '"')
          << name << ": " << text.substr(at - 20, 40);
    }
  }
  std::string log;
  EXPECT_EQ(
      test::run({"python3", "-c", "import sys, xml.dom.minidom as m; m.parse(sys.argv[1])", svg},
                &log),
      0)
      << name << log;
  EXPECT_EQ(test::run({"rsvg-convert", "--unlimited", "-o", png, svg}, &log), 0) << name << log;
}

PatchMesh colored(int columns, int rows, std::uint32_t seed, bool opaque = true) {
  PatchMesh patches = testing::random_patches(columns, rows, 80, 60, seed);
  testing::set_random_colors(patches, seed + 1, opaque);
  patches.opaque = opaque;
  return patches;
}

VectorImage picture(PatchMesh patches) { return testing::single_layer(std::move(patches), 80, 60); }

TEST(SvgRobustness, FoldedMeshes) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    PatchMesh patches = colored(6, 5, seed, seed != 2);
    testing::Random random(seed);
    for (auto& vertex : patches.mesh.vertices) {
      vertex += Eigen::Vector2d(random.uniform(-30, 30), random.uniform(-30, 30));
    }
    for (auto& tangents : patches.edge_tangents) {
      for (auto& tangent : tangents) tangent *= random.uniform(-5, 5);
    }
    expect_readable(picture(std::move(patches)), "folded" + std::to_string(seed));
  }
}

TEST(SvgRobustness, QuadsWithoutAnArea) {
  PatchMesh patches = colored(4, 4, 7);
  for (auto& vertex : patches.mesh.vertices) vertex.y() = 30;
  for (auto& tangents : patches.edge_tangents) {
    for (auto& tangent : tangents) tangent.y() = 0;
  }
  expect_readable(picture(patches), "line");
  for (auto& vertex : patches.mesh.vertices) vertex = {40, 30};
  for (auto& tangents : patches.edge_tangents) tangents.fill(Eigen::Vector2d::Zero());
  expect_readable(picture(patches), "point");
}

TEST(SvgRobustness, NumbersThatAreNone) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    PatchMesh patches = colored(4, 4, 8);
    patches.mesh.vertices[6].x() = bad;
    patches.wedges[12].value[1] = static_cast<float>(bad);
    expect_readable(picture(std::move(patches)), "none");
  }
}

/// Torn from top to bottom.
PatchMesh torn(bool opaque) {
  testing::SplitMesh split = testing::split_mesh(8, 6, 80, 60, 30, 50);
  testing::tear(split.mesh, split.line);
  PatchMesh patches = straight_patches(std::move(split.mesh));
  testing::set_random_colors(patches, 4, opaque);
  patches.opaque = opaque;
  return patches;
}

/// The largest coordinate in each file's paths, gradients and pictures.
std::vector<double> largest_coordinates(const std::vector<fs::path>& files) {
  std::vector<std::string> command = {
      "python3", "-c",
      "import re, sys, xml.etree.ElementTree as t\n"
      "names = {'d', 'x', 'y', 'width', 'height', 'x1', 'x2', 'y1', 'y2', 'cx',\n"
      "         'cy', 'r', 'gradientTransform', 'path'}\n"
      "for file in sys.argv[1:]:\n"
      "  print(max(abs(float(n)) for e in t.parse(file).getroot().iter()\n"
      "            for key, text in e.attrib.items() if key in names\n"
      "            for n in re.findall(r'-?\\d*\\.?\\d+(?:e[-+]?\\d+)?', text)))\n"};
  command.insert(command.end(), files.begin(), files.end());
  std::string said;
  EXPECT_EQ(test::run(command, &said), 0) << said;
  std::istringstream lines(said);
  return {std::istream_iterator<double>(lines), {}};
}

TEST(SvgRobustness, PatchesThatCannotBePaintedAreLeftOutAtTears) {
  constexpr int kRow = 9;  // vertices
  // On the tear and beside it, inside and at the border.
  const int corners[] = {4 + 3 * kRow, 5 + 3 * kRow, 3 + 2 * kRow, 4, 5};
  std::vector<fs::path> files;
  for (const double far : {std::nan(""), -1e9}) {
    for (const bool opaque : {true, false}) {
      for (const int corner : corners) {
        PatchMesh patches = torn(opaque);
        patches.mesh.vertices[corner] = Eigen::Vector2d(far, far);
        const VectorImage image = picture(std::move(patches));
        for (const SvgLevel level : {SvgLevel::compact, SvgLevel::hybrid, SvgLevel::inkscape}) {
          files.push_back(output("far-" + std::to_string(files.size()) + ".svg"));
          write_svg(image, files.back(), {.level = level});
        }
      }
    }
  }
  const std::vector<double> largest = largest_coordinates(files);
  ASSERT_EQ(largest.size(), files.size());
  for (std::size_t i = 0; i < files.size(); ++i) EXPECT_LT(largest[i], 10000) << files[i];
}

TEST(SvgRobustness, HybridFilesLeaveOutColorsThatAreNone) {
  PatchMesh patches = torn(true);
  patches.wedges[patches.wedge_of_corner[4 * 20]].value[1] = std::nanf("");
  expect_readable(picture(std::move(patches)), "hybrid", {.level = SvgLevel::hybrid});
}

TEST(SvgRobustness, OneQuadAndNothingToSee) {
  expect_readable(picture(colored(1, 1, 9)), "one");
  PatchMesh clear = colored(5, 4, 10, false);
  for (Wedge& wedge : clear.wedges) wedge = {};
  expect_readable(picture(std::move(clear)), "clear");
  VectorImage empty;
  empty.width = 80;
  empty.height = 60;
  expect_readable(empty, "empty");
}

TEST(SvgRobustness, AHundredThousandQuads) {
  PatchMesh patches = straight_patches(testing::lattice(400, 250, 800, 500));
  testing::set_linear_colors(patches, Color(0.1f, 0.9f, 0.3f, 1), Color(0.001f, 0, 0, 0),
                             Color(0, -0.001f, 0.001f, 0));
  expect_readable(testing::single_layer(std::move(patches), 800, 500), "many");
}

TEST(SvgRobustness, CancellingLeavesNoFile) {
  RunContext context;
  context.on_progress = [](const std::string&, double fraction) { return fraction < 0.5; };
  EXPECT_THROW(write_svg(picture(colored(40, 30, 11)), output("cancelled.svg"), {}, context),
               Error);
  EXPECT_FALSE(fs::exists(output("cancelled.svg")));
}

}  // namespace
}  // namespace quadrille
