#include "support/document_fuzz.h"

#include <gtest/gtest.h>

#include "finite_image.h"
#include "quadrille/document.h"
#include "quadrille/error.h"
#include "quadrille/patch_geometry.h"
#include "support/irregular_mesh.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

VectorImage small_image(unsigned seed, bool opaque) {
  QuadMesh mesh = testing::irregular_mesh(2, 2, 30, 20, seed);
  for (int e = 0; e < mesh.edge_count(); e += 3) mesh.edge_flags[e] = kTearEdge;
  PatchMesh patches = straight_patches(std::move(mesh));
  set_bessel_tangents(patches);
  testing::set_random_colors(patches, seed, opaque);
  patches.opaque = opaque;
  VectorImage image = testing::single_layer(std::move(patches), 30, 20);
  image.metadata["title"] = "small";
  return image;
}

/// `./dev bench fuzz-quad` is the long run.
TEST(DocumentFuzz, DamagedDocumentsGiveErrorsOrImages) {
  constexpr DocumentOptions kLossless{DocumentEncoding::lossless};
  testing::DocumentFuzz fuzz(
      {to_document(small_image(1, true)), to_document(small_image(2, false)),
       to_document(small_image(3, true), kLossless), to_document(small_image(4, false), kLossless)},
      1);
  int accepted = 0;
  for (int round = 0; round < 20000; ++round) {
    try {
      const VectorImage image = from_document(fuzz.next());
      ++accepted;
      ASSERT_TRUE(testing::is_finite(image)) << round;
    } catch (const Error&) {
    }
  }
  // Many changes hit numbers only, so the inner reader is reached.
  EXPECT_GT(accepted, 1000);
  EXPECT_LT(accepted, 19000);
}

}  // namespace
}  // namespace quadrille
