#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "librsvg.h"
#include "quadrille/export.h"
#include "quadrille/render.h"
#include "support/programs.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

constexpr int kColumns = 16, kRows = 12, kSpacing = 5;

/// Quads that are dark or light by chance, torn wherever the two meet: many meet at a corner alone.
VectorImage checkers(std::uint32_t seed) {
  const PatchMesh curved =
      testing::random_patches(kColumns, kRows, kColumns * kSpacing, kRows * kSpacing, seed);
  QuadMesh mesh = curved.mesh;
  testing::Random random(seed);
  std::vector<char> is_dark(mesh.quad_count());
  for (char& dark : is_dark) dark = random.uniform() < 0.4;
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.twin(h) < 0) continue;
    if (is_dark[QuadMesh::quad_of(h)] != is_dark[QuadMesh::quad_of(mesh.twin(h))]) {
      mesh.edge_flags[mesh.edge(h)] |= kTearEdge;
    }
  }
  PatchMesh patches = straight_patches(mesh);
  patches.edge_tangents = curved.edge_tangents;
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    const float shade = 0.1f * static_cast<float>(mesh.origin(h) % 3) / 2;
    const float value = is_dark[QuadMesh::quad_of(h)] ? shade : 1 - shade;
    patches.wedges[patches.wedge_of_corner[h]].value = Color(value, value, value, 1);
  }
  return testing::single_layer(std::move(patches), kColumns * kSpacing, kRows * kSpacing);
}

/// The range of the red channel over a pixel and its neighbours.
std::array<float, 2> range_around(const Raster& picture, int x, int y) {
  std::array<float, 2> range{1, 0};
  for (int j = std::max(0, y - 1); j <= std::min(picture.height - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(picture.width - 1, x + 1); ++i) {
      const float value = picture.pixel(i, j)[0];
      range = {std::min(range[0], value), std::max(range[1], value)};
    }
  }
  return range;
}

/// Pixels that are far from anything that they or their neighbours should show.
int specks(const Raster& drawn, const Raster& expected) {
  constexpr float kFar = 0.3f;
  int count = 0;
  for (int y = 0; y < drawn.height; ++y) {
    for (int x = 0; x < drawn.width; ++x) {
      const auto [least, most] = range_around(expected, x, y);
      const float value = drawn.pixel(x, y)[0];
      count += value < least - kFar || value > most + kFar;
    }
  }
  return count;
}

TEST(SvgTears, NothingReachesAcrossThem) {
  constexpr int kScale = 8;
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    const VectorImage image = checkers(seed);
    RenderOptions options;
    options.scale = kScale;
    const Raster expected = render(image, options);
    const auto svg = test::scratch_dir() / "tears.svg";
    write_svg(image, svg);
    const Raster drawn = test::drawn_by_librsvg(svg, {expected.width, expected.height});
    EXPECT_EQ(specks(drawn, expected), 0) << seed;
  }
}

}  // namespace
}  // namespace quadrille
