// A document of every version of the format, written when it was new.
#include <gtest/gtest.h>

#include <cmath>

#include "quadrille/document.h"
#include "quadrille/render.h"

namespace quadrille {
namespace {

VectorImage document_of(const char* name) {
  return load_document(std::string(QUADRILLE_SOURCE_DIR) + "/tests/patches/documents/" + name);
}

void expect_pixel(const Raster& picture, int x, int y, const std::array<float, 4>& rgba) {
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(picture.pixel(x, y)[c], rgba[c], 2e-5) << x << ", " << y;
}

TEST(DocumentVersions, One) {
  const VectorImage image = document_of("version_1_lossless.quad");
  const PatchMesh& patches = image.layers.at(0).patches;
  EXPECT_EQ(image.width, 256);
  EXPECT_EQ(image.metadata.at("source"), "flower_256_alpha.png");
  EXPECT_EQ(patches.patch_count(), 24);
  EXPECT_EQ(patches.wedges.size(), 35u);
  EXPECT_FALSE(patches.opaque);
  EXPECT_EQ(patches.mesh.vertices[12], Eigen::Vector2d(137.26413387125748, 212.51171343440515));
  EXPECT_EQ(patches.wedges[12].value[0], 0.383463174f);
  EXPECT_EQ(patches.wedges[20].twist[3], -0.000105469291f);
  const Raster picture = render(image);
  expect_pixel(picture, 60, 90, {1, 0.435553f, 0.880530f, 1});
  expect_pixel(picture, 200, 180, {0.893220f, 0.462583f, 0.784985f, 0.851608f});
}

TEST(DocumentVersions, Two) {
  const VectorImage image = document_of("version_2_quantized.quad");
  const PatchMesh& patches = image.layers.at(0).patches;
  EXPECT_EQ(image.height, 256);
  EXPECT_EQ(patches.patch_count(), 24);
  EXPECT_EQ(patches.mesh.vertex_count(), 35);
  EXPECT_EQ(patches.wedges.size(), 60u);
  int tears = 0;
  for (int e = 0; e < patches.mesh.edge_count(); ++e) tears += patches.mesh.is_tear(e);
  EXPECT_EQ(tears, 20);
  EXPECT_EQ(patches.mesh.vertices[30], Eigen::Vector2d(204.25, 223.25));
  EXPECT_NEAR(patches.wedges[12].value[0], 0.407111079, 1e-7);
  EXPECT_NEAR(patches.wedges[20].twist[3], 0.00197773986, 1e-9);
  const Raster picture = render(image);
  expect_pixel(picture, 60, 90, {1, 0.412988f, 0.870470f, 1});
  expect_pixel(picture, 200, 180, {1, 0.447051f, 0.874848f, 0.988165f});
}

}  // namespace
}  // namespace quadrille
