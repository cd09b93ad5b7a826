#include "quadrille/document.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "document_container.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using Bytes = std::vector<std::byte>;
constexpr DocumentOptions kLossless{DocumentEncoding::lossless};
using Random = std::mt19937;

double real(Random& random) { return (static_cast<double>(random()) - 2147483648.0) / 4096.0; }

/// A lattice with random positions, tangents, tears, flags and colours; the document need not know
/// that it would fold.
PatchMesh random_patches(Random& random, int columns, int rows, bool torn) {
  std::vector<Eigen::Vector2d> vertices((columns + 1) * (rows + 1));
  for (auto& v : vertices) v = {real(random), real(random)};
  std::vector<QuadMesh::Quad> quads;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const int a = y * (columns + 1) + x, b = a + columns + 1;
      quads.push_back({a, a + 1, b + 1, b});
    }
  }
  QuadMesh mesh(std::move(vertices), std::move(quads));
  for (auto& flags : mesh.edge_flags) {
    flags = random() % 2 ? kFeatureEdge : 0;
    if (torn && random() % 3 == 0) flags |= kTearEdge;
  }
  PatchMesh patches = straight_patches(std::move(mesh));
  for (auto& tangents : patches.edge_tangents) {
    for (auto& t : tangents) t = {real(random), real(random)};
  }
  for (Wedge& w : patches.wedges) {
    for (Color* c : {&w.value, &w.dx, &w.dy, &w.twist}) {
      for (int k = 0; k < 4; ++k) (*c)[k] = static_cast<float>(real(random));
    }
  }
  patches.opaque = random() % 2;
  return patches;
}

VectorImage random_image(unsigned seed, bool torn = true) {
  Random random(seed);
  VectorImage image;
  image.width = 1 + random() % 5000;
  image.height = 0.5 + random() % 5000;
  const int layers = 1 + static_cast<int>(random() % 3);
  for (int l = 0; l < layers; ++l) {
    Layer layer;
    layer.name = "layer " + std::to_string(l) + " \u00e4\u4e2d";
    if (l > 0) {
      layer.transform.matrix() << real(random), real(random), real(random), real(random),
          real(random), real(random), 0, 0, 1;
    }
    layer.patches = random_patches(random, 1 + random() % 9, 1 + random() % 9, torn);
    image.layers.push_back(std::move(layer));
  }
  image.metadata = {{"source", "a \"b\".png"}, {"options", "--quads 3000"}, {"empty", ""}};
  return image;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(static_cast<const void*>(a.data()),
                                                           b.data(), a.size() * sizeof(T)) == 0);
}

void expect_same(const VectorImage& a, const VectorImage& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.metadata, b.metadata);
  ASSERT_EQ(a.layers.size(), b.layers.size());
  for (std::size_t l = 0; l < a.layers.size(); ++l) {
    const PatchMesh &p = a.layers[l].patches, &q = b.layers[l].patches;
    EXPECT_EQ(a.layers[l].name, b.layers[l].name);
    EXPECT_EQ(a.layers[l].transform.matrix(), b.layers[l].transform.matrix());
    EXPECT_EQ(p.opaque, q.opaque);
    EXPECT_EQ(p.mesh.quads(), q.mesh.quads());
    EXPECT_TRUE(same_bits(p.mesh.vertices, q.mesh.vertices));
    EXPECT_EQ(p.mesh.edge_flags, q.mesh.edge_flags);
    EXPECT_TRUE(same_bits(p.edge_tangents, q.edge_tangents));
    EXPECT_EQ(p.wedge_of_corner, q.wedge_of_corner);
    EXPECT_TRUE(same_bits(p.wedges, q.wedges));
  }
}

ErrorCode code_of(const Bytes& bytes) {
  try {
    from_document(bytes, "test.quad");
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("test.quad"), std::string::npos) << error.what();
    return error.code();
  }
  ADD_FAILURE() << "the document was accepted";
  return {};
}

/// Accepting is fine as long as what comes out is a proper image; anything but Error is not.
void expect_harmless(const Bytes& bytes) {
  try {
    to_document(from_document(bytes), kLossless);
  } catch (const Error&) {
  }
}

TEST(Document, RoundTripIsBitExact) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const VectorImage image = random_image(seed, seed % 2);
    const Bytes bytes = to_document(image, kLossless);
    const VectorImage loaded = from_document(bytes);
    expect_same(image, loaded);
    EXPECT_EQ(to_document(loaded, kLossless), bytes);
  }
}

TEST(Document, KeepsWedgesNumberedInAnyOrder) {
  VectorImage image = random_image(1);
  PatchMesh& patches = image.layers[0].patches;
  const int last = static_cast<int>(patches.wedges.size()) - 1;
  for (int& w : patches.wedge_of_corner) w = last - w;
  expect_same(image, from_document(to_document(image, kLossless)));
}

TEST(Document, HoldsAnImageWithoutLayersOrPatches) {
  VectorImage image;
  image.width = image.height = 1;
  expect_same(image, from_document(to_document(image, kLossless)));
  image.layers.emplace_back();
  expect_same(image, from_document(to_document(image, kLossless)));
}

TEST(Document, RefusesForeignFilesAndNewerVersions) {
  const std::string png = "\x89PNG\r\n\x1a\n and more than a header's worth of bytes";
  const auto* begin = reinterpret_cast<const std::byte*>(png.data());
  EXPECT_EQ(code_of(Bytes(begin, begin + png.size())), ErrorCode::unsupported_format);
  EXPECT_EQ(code_of({}), ErrorCode::unsupported_format);

  Bytes newer = to_document(random_image(2), kLossless);
  newer[8] = std::byte{kDocumentVersion + 1};
  EXPECT_EQ(code_of(newer), ErrorCode::unsupported_format);
}

TEST(Document, RefusesClaimsOfGiantSizesBeforeUnpacking) {
  Bytes bytes = to_document(random_image(3), kLossless);
  bytes[12 + 7] = std::byte{1};
  EXPECT_EQ(code_of(bytes), ErrorCode::limit_exceeded);
  bytes[12 + 7] = std::byte{0};
  bytes[12 + 3] = std::byte{0x7f};
  EXPECT_EQ(code_of(bytes), ErrorCode::io_failure);
}

TEST(Document, RefusesWhatContradictsItself) {
  const auto damaged = [](auto change) {
    VectorImage image = random_image(4);
    change(image, image.layers[0].patches);
    return code_of(to_document(image, kLossless));
  };
  using Image = VectorImage;
  const double nan = std::nan("");
  EXPECT_EQ(damaged([&](Image& i, PatchMesh&) { i.width = nan; }), ErrorCode::io_failure);
  EXPECT_EQ(damaged([](Image& i, PatchMesh&) { i.height = 0; }), ErrorCode::io_failure);
  EXPECT_EQ(damaged([&](Image& i, PatchMesh&) { i.layers[0].transform(0, 2) = nan; }),
            ErrorCode::io_failure);
  EXPECT_EQ(damaged([&](Image&, PatchMesh& p) { p.mesh.vertices[0].x() = nan; }),
            ErrorCode::io_failure);
  EXPECT_EQ(damaged([](Image&, PatchMesh& p) { p.mesh.vertices.pop_back(); }),
            ErrorCode::io_failure);
  EXPECT_EQ(damaged([](Image&, PatchMesh& p) { p.mesh.edge_flags.push_back(0); }),
            ErrorCode::io_failure);
  EXPECT_EQ(damaged([](Image&, PatchMesh& p) { p.edge_tangents.pop_back(); }),
            ErrorCode::io_failure);
  EXPECT_EQ(damaged([&](Image&, PatchMesh& p) { p.edge_tangents[0][1].y() = INFINITY; }),
            ErrorCode::io_failure);
  EXPECT_EQ(damaged([](Image&, PatchMesh& p) { p.wedges.emplace_back(); }), ErrorCode::io_failure);
  EXPECT_EQ(damaged([](Image&, PatchMesh& p) { p.wedges[0].twist[3] = -INFINITY; }),
            ErrorCode::io_failure);
  EXPECT_EQ(damaged([](Image&, PatchMesh& p) { p.wedge_of_corner[0] = -1; }),
            ErrorCode::io_failure);
  EXPECT_EQ(damaged([](Image&, PatchMesh& p) {
              p.wedge_of_corner[0] = static_cast<int>(p.wedges.size());
            }),
            ErrorCode::io_failure);
  EXPECT_EQ(
      damaged([](Image&, PatchMesh& p) { std::swap(p.wedge_of_corner[0], p.wedge_of_corner[2]); }),
      ErrorCode::io_failure);
}

TEST(Document, EveryTruncationIsRefused) {
  const Bytes bytes = to_document(random_image(5), kLossless);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 64) {
    EXPECT_THROW(from_document({bytes.data(), size}), Error) << size;
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_THROW(from_document(longer), Error);
}

TEST(Document, MutatedFilesGiveErrorsOrTheSameImage) {
  const Bytes bytes = to_document(random_image(6), kLossless);
  Random random(1);
  for (int round = 0; round < 2000; ++round) {
    Bytes mutated = bytes;
    for (unsigned k = 0; k <= random() % 4; ++k) {
      mutated[random() % mutated.size()] = static_cast<std::byte>(random());
    }
    try {
      // A few bits of a zstd frame's header have no meaning.
      EXPECT_EQ(to_document(from_document(mutated), kLossless), bytes);
    } catch (const Error&) {
    }
  }
}

TEST(Document, MutatedContentsGiveErrorsOrProperImages) {
  const std::vector<std::uint8_t> content =
      unpack_document(to_document(random_image(7), kLossless), "").content;
  Random random(2);
  for (int round = 0; round < 1500; ++round) {
    std::vector<std::uint8_t> mutated = content;
    // The offsets and tables lie at both ends; most of the middle is numbers.
    const std::size_t range =
        round % 2 ? mutated.size() : std::min<std::size_t>(256, mutated.size());
    for (unsigned k = 0; k <= random() % 4; ++k) {
      mutated[random() % range] = static_cast<std::uint8_t>(random());
    }
    if (round % 8 == 0) mutated.resize(random() % mutated.size());
    expect_harmless(pack_document(mutated, kLosslessVersion, 0));
  }
}

TEST(Document, SavesAndLoadsFiles) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "quadrille_document_test";
  std::filesystem::create_directories(folder);
  const VectorImage image = random_image(8);
  save_document(image, folder / "a.quad", kLossless);
  expect_same(image, load_document(folder / "a.quad"));
  const StoredImage stored = load_document_and_storage(folder / "a.quad");
  expect_same(image, stored.image);
  EXPECT_EQ(stored.storage.file_bytes, std::filesystem::file_size(folder / "a.quad"));
  ASSERT_EQ(stored.storage.layers.size(), image.layers.size());
  EXPECT_EQ(stored.storage.layers[0].encoding, DocumentEncoding::lossless);
  save_document(random_image(9), folder / "a.quad", kLossless);
  EXPECT_EQ(load_document(folder / "a.quad").width, random_image(9).width);
  EXPECT_THROW(save_document(image, folder / "missing" / "a.quad", kLossless), Error);
  EXPECT_THROW(load_document(folder / "none.quad"), Error);
  EXPECT_THROW(load_document(folder), Error);
  const auto entries = std::distance(std::filesystem::directory_iterator(folder), {});
  EXPECT_EQ(entries, 1);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace quadrille
