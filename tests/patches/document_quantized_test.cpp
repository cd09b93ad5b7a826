#include <gtest/gtest.h>

#include <cmath>

#include "document_container.h"
#include "document_metric.h"
#include "finite_image.h"
#include "quadrille/document.h"
#include "quadrille/error.h"
#include "quadrille/patch_geometry.h"
#include "quadrille/render.h"
#include "support/irregular_mesh.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using testing::irregular_mesh;
using testing::random_patches;
using testing::set_random_colors;
using testing::single_layer;

constexpr DocumentOptions kFine{DocumentEncoding::quantized, 16, 1 / 64.0};

VectorImage reloaded(const VectorImage& image, const DocumentOptions& options = {}) {
  return from_document(to_document(image, options));
}

/// Every `every`-th inner edge becomes a tear; neighbouring ones divide vertices.
void tear(PatchMesh& patches, int every) {
  QuadMesh mesh = patches.mesh;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (e % every == 0 && !mesh.is_border(e)) mesh.edge_flags[e] |= kTearEdge;
  }
  const auto tangents = patches.edge_tangents;
  patches = straight_patches(std::move(mesh));
  patches.edge_tangents = tangents;
}

/// Irregular (3, 5 and more quads around a vertex), with curved edges, tears and any colours.
VectorImage irregular_image(unsigned seed, bool torn, bool opaque) {
  PatchMesh patches = straight_patches(irregular_mesh(5, 4, 101.5, 80, seed));
  set_bessel_tangents(patches);
  guard_folds(patches);
  if (torn) tear(patches, 3);
  set_random_colors(patches, seed, opaque);
  patches.opaque = opaque;
  return single_layer(std::move(patches), 101.5, 80);
}

double largest_difference(const VectorImage& a, const VectorImage& b) {
  const Raster p = render(a, {.scale = 2}), q = render(b, {.scale = 2});
  EXPECT_EQ(p.channels, q.channels);
  double largest = 0;
  for (std::size_t i = 0; i < p.data.size(); ++i) {
    largest = std::max<double>(largest, std::abs(p.data[i] - q.data[i]));
  }
  return largest;
}

/// Mean absolute difference of the pictures at scale 1, of 255.
double mean_difference(const VectorImage& a, const VectorImage& b) {
  const Raster p = render(a), q = render(b);
  double sum = 0;
  for (std::size_t i = 0; i < p.data.size(); ++i) sum += std::abs(p.data[i] - q.data[i]);
  return 255 * sum / static_cast<double>(p.data.size());
}

TEST(QuantizedDocument, FineStepsKeepThePictureOfAnyMesh) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const VectorImage image = irregular_image(seed, seed % 2, seed % 3);
    const VectorImage loaded = reloaded(image, kFine);
    // Signs of twists, sides of tears and neighbours must all be right for this.
    EXPECT_LT(largest_difference(image, loaded), 0.02) << seed;
    EXPECT_EQ(loaded.layers[0].patches.wedges.size(), image.layers[0].patches.wedges.size());
    EXPECT_EQ(loaded.opaque(), image.opaque());
  }
}

TEST(QuantizedDocument, SavingAgainGivesTheSameBytes) {
  for (const int bits : {2, 6, 10}) {
    for (unsigned seed = 0; seed < 12; ++seed) {
      const DocumentOptions options{DocumentEncoding::quantized, bits, 1};
      const auto bytes = to_document(irregular_image(seed, seed % 2, seed % 3), options);
      EXPECT_EQ(to_document(from_document(bytes), options), bytes) << seed;
    }
  }
}

TEST(QuantizedDocument, SavingAgainGivesTheSameBytesWithStepsOfItsChoice) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const auto bytes = to_document(irregular_image(seed, seed % 2, seed % 3));
    EXPECT_EQ(to_document(from_document(bytes)), bytes) << seed;
  }
}

TEST(QuantizedDocument, SavingAgainGivesTheSameBytesForOneColor) {
  for (int level = 0; level < 32; ++level) {
    PatchMesh patches = straight_patches(irregular_mesh(3, 2, 40, 30, 7));
    for (Wedge& w : patches.wedges) w.value << level / 255.f, level / 99.f, 0.5f, 1.f;
    const auto bytes = to_document(single_layer(std::move(patches), 40, 30));
    EXPECT_EQ(to_document(from_document(bytes)), bytes) << level;
  }
}

TEST(QuantizedDocument, TheErrorIsTheWishedOne) {
  for (const double wished : {0.1, 0.3, 0.5}) {
    for (unsigned seed = 0; seed < 6; ++seed) {
      PatchMesh patches = straight_patches(testing::irregular_mesh(5, 4, 101.5, 80, seed));
      set_bessel_tangents(patches);
      guard_folds(patches);
      set_random_colors(patches, seed, true);
      const VectorImage image = single_layer(std::move(patches), 101.5, 80);
      const VectorImage loaded = reloaded(image, {.error = wished});
      const double error = mean_difference(image, loaded);
      EXPECT_LT(error, 1.1 * wished) << seed;
      EXPECT_GT(error, 0.6 * wished) << seed;
    }
  }
}

TEST(QuantizedDocument, FinerStepsStayWhenSavedAgainByDefault) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const auto bytes = to_document(irregular_image(seed, seed % 2, seed % 3), {.error = 0.125});
    EXPECT_EQ(to_document(from_document(bytes)), bytes) << seed;
  }
}

TEST(QuantizedDocument, RoundingMayCostWhatPatchesMissWithinBounds) {
  EXPECT_EQ(document_error(0), 0.125);
  EXPECT_EQ(document_error(0.2), 0.2);
  EXPECT_EQ(document_error(5), DocumentOptions{}.error);
}

TEST(QuantizedDocument, RoundedVerticesHardlyChangeASmoothPicture) {
  PatchMesh patches = straight_patches(testing::lattice(8, 6, 81, 61));
  for (int v = 0; v < patches.mesh.vertex_count(); ++v) {
    if (patches.mesh.is_border_vertex(v)) continue;
    patches.mesh.vertices[v] += Eigen::Vector2d(std::sin(5.0 * v), std::cos(3.0 * v));
  }
  patches = straight_patches(patches.mesh);
  for (int v = 0; v < patches.mesh.vertex_count(); ++v) {
    const auto x = static_cast<float>(patches.mesh.vertices[v].x());
    patches.wedges[v].value << x / 100, x / 100, x / 100, 1;
    patches.wedges[v].dx << 0.01f, 0.01f, 0.01f, 0;
  }
  const VectorImage image = single_layer(std::move(patches), 81, 61);
  const VectorImage loaded = reloaded(image, {DocumentEncoding::quantized, 1, 1 / 64.0});
  EXPECT_LT(largest_difference(image, loaded), 0.001);
}

TEST(QuantizedDocument, SavingAgainGivesTheSameBytesForFreeTangents) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    PatchMesh patches = random_patches(9, 7, 90, 70, seed);
    set_random_colors(patches, seed);
    const VectorImage image = single_layer(std::move(patches), 90, 70);
    const auto bytes = to_document(image);
    EXPECT_EQ(to_document(from_document(bytes)), bytes) << seed;
  }
}

TEST(QuantizedDocument, TheMeshStaysValidAndFreeOfFolds) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const VectorImage loaded = reloaded(irregular_image(seed, true, true));
    const PatchMesh& patches = loaded.layers[0].patches;
    EXPECT_TRUE(validate(patches.mesh, loaded.width, loaded.height).empty()) << seed;
    for (int q = 0; q < patches.patch_count(); ++q) {
      EXPECT_TRUE(certify_fold_free(patch_geometry(patches, q))) << seed << " " << q;
    }
  }
}

TEST(QuantizedDocument, QuadsBelowAPixelDoNotFold) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    // Of few colours: their error alone would allow half pixels.
    PatchMesh patches = straight_patches(irregular_mesh(30, 20, 30, 20, seed));
    for (Wedge& w : patches.wedges) w.value << 0.5f, 0.25f, 0.75f, 1.f;
    const auto bytes = to_document(single_layer(std::move(patches), 30, 20));
    const VectorImage loaded = from_document(bytes);
    const PatchMesh& after = loaded.layers[0].patches;
    for (int q = 0; q < after.patch_count(); ++q) {
      ASSERT_TRUE(certify_fold_free(patch_geometry(after, q))) << seed << " " << q;
    }
    EXPECT_EQ(to_document(loaded), bytes) << seed;
  }
}

TEST(QuantizedDocument, TangentsChangedAfterLoadingAreNotRoundedBlindly) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    VectorImage image = reloaded(irregular_image(seed, false, true), {.error = 1});
    PatchMesh& patches = image.layers[0].patches;
    for (int e = 0; e < patches.mesh.edge_count(); ++e) {
      if (patches.mesh.is_border(e)) continue;
      const Eigen::Vector2d bend(0.4 * std::sin(3.0 * e), 0.4 * std::cos(5.0 * e));
      for (Eigen::Vector2d& t : patches.edge_tangents[e]) t += bend;
    }
    EXPECT_LT(mean_difference(image, reloaded(image, {.error = 0.05})), 0.055) << seed;
  }
}

TEST(QuantizedDocument, PatchesThatVanishOnTheGridStayFinite) {
  // Smaller than the finest step, among others or alone.
  for (const double size : {1e-3, 1e-6, 1e-12}) {
    for (const bool alone : {false, true}) {
      PatchMesh patches = straight_patches(
          alone ? QuadMesh({{3, 3}, {3 + size, 3}, {3 + size, 3 + size}, {3, 3 + size}},
                           {{0, 1, 2, 3}})
                : QuadMesh({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {9 + size, 0}, {9 + size, 9}},
                           {{0, 1, 2, 3}, {1, 4, 5, 2}}));
      set_random_colors(patches, 5, true);
      const VectorImage image = single_layer(std::move(patches), 10, 10);
      for (const DocumentOptions& options :
           {DocumentOptions{}, DocumentOptions{.position_bits = -8}}) {
        EXPECT_TRUE(testing::is_finite(reloaded(image, options))) << size << " " << alone;
      }
    }
  }
}

TEST(PictureMetric, IsPositiveForNumbersOutOfProportion) {
  for (const double tangent : {0.0, 1e10, 1e80, 1e200}) {
    PatchMesh patches = straight_patches(testing::lattice(2, 2, 1, 1));
    for (Eigen::Vector2d& p : patches.mesh.vertices) p.setZero();
    for (auto& tangents : patches.edge_tangents) tangents.fill({tangent, tangent});
    const PictureMetric metric(patches, color_frames(patches.mesh, 0.5));
    for (int w = 0; w < metric.wedge_count(); ++w) {
      LocalColors ones;
      ones.fill(Eigen::Array4d::Ones());
      for (const Eigen::Array4d& kind : metric.solve_block(w, ones)) {
        EXPECT_TRUE(kind.isFinite().all()) << tangent;
      }
      EXPECT_GT(metric.root(w).diagonal().minCoeff(), 0) << tangent;
    }
  }
}

TEST(QuantizedDocument, KeepsFlagsAndLengthsOfTears) {
  const VectorImage image = irregular_image(3, true, true);
  const VectorImage loaded = reloaded(image, kFine);
  const auto tears_of = [](const VectorImage& i) {
    const QuadMesh& mesh = i.layers[0].patches.mesh;
    double count = 0, length = 0;
    for (int e = 0; e < mesh.edge_count(); ++e) {
      if (!mesh.is_tear(e)) continue;
      const int h = mesh.halfedge(e);
      length += (mesh.vertices[mesh.tip(h)] - mesh.vertices[mesh.origin(h)]).norm();
      count += 1;
    }
    return std::pair(count, length);
  };
  EXPECT_GT(tears_of(image).first, 0);
  EXPECT_EQ(tears_of(loaded).first, tears_of(image).first);
  EXPECT_NEAR(tears_of(loaded).second, tears_of(image).second, 0.01);
}

TEST(QuantizedDocument, PositionsMoveByHalfAStepAtMost) {
  const VectorImage image = irregular_image(4, false, true);
  const QuadMesh& before = image.layers[0].patches.mesh;
  const VectorImage loaded = reloaded(image, {DocumentEncoding::quantized, 3, 1});
  for (const Eigen::Vector2d& p : loaded.layers[0].patches.mesh.vertices) {
    double nearest = 1e9;
    for (const Eigen::Vector2d& v : before.vertices) {
      nearest = std::min(nearest, (p - v).lpNorm<Eigen::Infinity>());
    }
    EXPECT_LE(nearest, 1 / 16.0);
  }
}

TEST(QuantizedDocument, LayersWithoutACommonPieceOrPatchesComeBack) {
  // Two separate quads, the second one listed with another corner first.
  QuadMesh mesh({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {10, 0}, {14, 0}, {14, 4}, {10, 4}},
                {{0, 1, 2, 3}, {6, 7, 4, 5}});
  VectorImage image = single_layer(straight_patches(std::move(mesh)), 14, 4);
  image.layers.emplace_back();
  image.layers[1].name = "nothing";
  image.metadata["title"] = "two";
  const VectorImage loaded = reloaded(image);
  EXPECT_EQ(loaded.patch_count(), 2);
  EXPECT_EQ(loaded.layers[1].name, "nothing");
  EXPECT_EQ(loaded.metadata, image.metadata);
  EXPECT_EQ(largest_difference(image, loaded), 0);
}

TEST(QuantizedDocument, WhatItCannotHoldIsStoredLossless) {
  VectorImage image = irregular_image(5, false, true);
  image.layers[0].patches.mesh.vertices[0].x() = -1e12;
  const VectorImage loaded = reloaded(image);
  EXPECT_EQ(loaded.layers[0].patches.mesh.vertices, image.layers[0].patches.mesh.vertices);
  EXPECT_EQ(loaded.layers[0].patches.mesh.quads(), image.layers[0].patches.mesh.quads());
}

TEST(QuantizedDocument, AUniformPictureIsSmallButNotBelowTheLeastSize) {
  PatchMesh patches = straight_patches(testing::lattice(100, 100, 400, 400));
  const VectorImage image = single_layer(std::move(patches), 400, 400);
  const auto bytes = to_document(image);
  EXPECT_EQ(bytes.size(), 10000u / kMostQuadsPerByte);
  EXPECT_EQ(from_document(bytes).patch_count(), 10000);

  auto shorter = bytes;
  shorter.pop_back();
  EXPECT_THROW(from_document(shorter), Error);
}

TEST(QuantizedDocument, RefusesOptionsOutOfRange) {
  const VectorImage image = irregular_image(6, false, true);
  EXPECT_THROW(to_document(image, {DocumentEncoding::quantized, 17, 1}), Error);
  EXPECT_THROW(to_document(image, {DocumentEncoding::quantized, 6, 0}), Error);
  EXPECT_THROW(to_document(image, {DocumentEncoding::quantized, 6, std::nan("")}), Error);
  EXPECT_THROW(to_document(image, {.error = 0}), Error);
}

}  // namespace
}  // namespace quadrille
