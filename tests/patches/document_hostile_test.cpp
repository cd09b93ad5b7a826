// Documents that no writer makes: valid FlatBuffers with codes that end where they should.
#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <functional>

#include "document_colors.h"
#include "document_connectivity.h"
#include "document_container.h"
#include "document_geometry.h"
#include "document_patches.h"
#include "document_shapes.h"
#include "finite_image.h"
#include "quadrille/document.h"
#include "quadrille/error.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

const fbs::Affine kIdentity(1, 0, 0, 1, 0, 0);
constexpr std::uint64_t kQuads = 4096;  // that the file's size allows to claim

/// What a quantised layer says.
struct Claims {
  double width = 8, height = 6;
  int exponent = 3;
  float color_step = 1 / 255.f;
  int number = 1000;                          ///< all numbers of all colours
  std::function<Eigen::Vector2i(int)> point;  ///< of a vertex; where it is, if absent
};

Offset<fbs::QuantizedPatches> store(FlatBufferBuilder& builder, const Claims& claims) {
  const PositionGrid grid(claims.exponent, claims.width, claims.height);
  RangeEncoder connectivity, geometry, colors;
  QuantizedPatches patches;
  patches.mesh = encode_connectivity(connectivity, testing::lattice(3, 2, 8, 6)).mesh;
  patches.shapes.resize(patches.mesh.edge_count());
  for (int v = 0; v < patches.mesh.vertex_count(); ++v) {
    Eigen::Vector2d& p = patches.mesh.vertices[v];
    patches.points.push_back(claims.point
                                 ? claims.point(v)
                                 : Eigen::Vector2i(grid.nearest(0, p.x()), grid.nearest(1, p.y())));
    p = grid.at(patches.points.back());
  }
  set_tangents(grid.step(), patches);
  const PatchMesh wedges = straight_patches(patches.mesh);
  patches.wedge_of_corner = wedges.wedge_of_corner;
  WedgeCode code;
  for (auto& channel : code) channel.fill(claims.number);
  patches.wedges.assign(wedges.wedges.size(), code);
  encode_geometry(geometry, patches, grid);
  encode_colors(colors, patches, grid, 1 / 255.0);
  const auto stored_connectivity = builder.CreateVector(connectivity.finish());
  const auto stored_geometry = builder.CreateVector(geometry.finish());
  const auto stored_colors = builder.CreateVector(colors.finish());
  return fbs::CreateQuantizedPatches(builder, static_cast<std::uint32_t>(patches.mesh.quad_count()),
                                     static_cast<std::int8_t>(claims.exponent), claims.color_step,
                                     stored_connectivity, stored_geometry, stored_colors);
}

std::vector<std::byte> finish(FlatBufferBuilder& builder, double width, double height,
                              const std::vector<Offset<fbs::Layer>>& layers,
                              const std::vector<Offset<fbs::MetadataEntry>>& metadata) {
  const auto stored_layers = builder.CreateVector(layers);
  const auto stored_metadata = builder.CreateVector(metadata);
  fbs::FinishDocumentBuffer(
      builder, fbs::CreateDocument(builder, width, height, stored_layers, stored_metadata));
  return pack_document({builder.GetBufferPointer(), builder.GetSize()}, kQuantizedVersion, kQuads);
}

std::vector<std::byte> document_of(const Claims& claims) {
  FlatBufferBuilder builder;
  const auto name = builder.CreateString("layer");
  const auto patches = store(builder, claims).Union();
  const auto layer =
      fbs::CreateLayer(builder, name, &kIdentity, true, fbs::Patches::QuantizedPatches, patches);
  return finish(builder, claims.width, claims.height, {layer}, {});
}

TEST(HostileDocument, TheHandMadeOneIsReadAsItIs) {
  const VectorImage image = from_document(document_of({}));
  EXPECT_EQ(image.patch_count(), 6);
  EXPECT_TRUE(testing::is_finite(image));
}

TEST(HostileDocument, VerticesOnOnePointGiveFiniteNumbers) {
  for (const int exponent : {-24, 0, 3, 24}) {
    Claims claims;
    claims.exponent = exponent;
    claims.width = claims.height = std::ldexp(100.0, -exponent);
    for (const int at : {0, 7, 100, 1 << 24}) {
      claims.point = [&](int) { return Eigen::Vector2i(at, at); };
      EXPECT_TRUE(testing::is_finite(from_document(document_of(claims)))) << exponent << " " << at;
    }
  }
}

TEST(HostileDocument, ColorStepsOutOfRangeAreRefused) {
  for (const float step : {0.f, -1.f, FLT_MIN, FLT_MAX, INFINITY, NAN}) {
    Claims claims;
    claims.color_step = step;
    EXPECT_THROW(from_document(document_of(claims)), Error) << step;
  }
}

TEST(HostileDocument, TheLargestNumbersAtTheFarthestStepsStayFinite) {
  for (const int exponent : {-24, 24}) {
    for (const float step : {0x1p-24f, 256.f}) {
      for (const int number : {-(1 << 24), 1 << 24}) {
        Claims claims;
        claims.exponent = exponent;
        claims.width = claims.height = std::ldexp(100.0, -exponent);
        claims.color_step = step;
        claims.number = number;
        // One corner far away, all others together.
        claims.point = [](int v) { return Eigen::Vector2i(v == 5 ? 1 << 24 : 1, v == 5); };
        try {
          EXPECT_TRUE(testing::is_finite(from_document(document_of(claims))));
        } catch (const Error&) {  // the prediction may leave the range of the codes
        }
      }
    }
  }
}

TEST(HostileDocument, ASideWhoseSquareVanishesIsRefused) {
  Claims claims;
  claims.width = 1e-200;
  claims.point = [](int v) { return Eigen::Vector2i(v % 2, 3 * v); };
  EXPECT_THROW(from_document(document_of(claims)), Error);
}

TEST(HostileDocument, LayersThatShareTheirPatchesAreRefused) {
  for (const int count : {1, 2, 1000}) {
    FlatBufferBuilder builder;
    const auto name = builder.CreateString("layer");
    const auto patches =
        store_patches(builder, straight_patches(testing::lattice(30, 30, 8, 6))).Union();
    std::vector<Offset<fbs::Layer>> layers;
    for (int l = 0; l < count; ++l) {
      layers.push_back(fbs::CreateLayer(builder, name, &kIdentity, true,
                                        fbs::Patches::LosslessPatches, patches));
    }
    const auto bytes = finish(builder, 8, 6, layers, {});
    if (count == 1) {
      EXPECT_EQ(from_document(bytes).patch_count(), 900);
    } else {
      EXPECT_THROW(from_document(bytes), Error);
    }
  }
}

TEST(HostileDocument, ManyOffsetsToOneSmallLayerAreRefused) {
  FlatBufferBuilder builder;
  const auto name = builder.CreateString("");
  const auto patches = store_patches(builder, {}).Union();
  const auto layer =
      fbs::CreateLayer(builder, name, &kIdentity, true, fbs::Patches::LosslessPatches, patches);
  const auto bytes = finish(builder, 8, 6, std::vector(10000, layer), {});
  EXPECT_THROW(from_document(bytes), Error);
}

TEST(HostileDocument, MetadataThatSharesAStringIsRefused) {
  FlatBufferBuilder builder;
  const auto value = builder.CreateString(std::string(5000, 'x'));
  std::vector<Offset<fbs::MetadataEntry>> metadata;
  for (int m = 0; m < 1000; ++m) {
    const auto key = builder.CreateString(std::to_string(1000 + m));
    metadata.push_back(fbs::CreateMetadataEntry(builder, key, value));
  }
  EXPECT_THROW(from_document(finish(builder, 8, 6, {}, metadata)), Error);
}

TEST(HostileDocument, ManySmallLayersAndEntriesAreNotSuspicious) {
  VectorImage image;
  image.width = image.height = 1;
  image.layers.resize(1000);
  for (int m = 0; m < 1000; ++m) image.metadata[std::to_string(m)] = "";
  for (const auto encoding : {DocumentEncoding::lossless, DocumentEncoding::quantized}) {
    const VectorImage loaded = from_document(to_document(image, {encoding}));
    EXPECT_EQ(loaded.layers.size(), 1000u);
    EXPECT_EQ(loaded.metadata, image.metadata);
  }
}

}  // namespace
}  // namespace quadrille
