#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/document.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "support/programs.h"
#include "support/python_with_vtk.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

fs::path output(const std::string& name) { return test::scratch_dir() / ("round_trip_" + name); }

/// Equal documents mean equal images, bit for bit.
std::vector<std::byte> bits_of(const VectorImage& image) {
  DocumentOptions options;
  options.encoding = DocumentEncoding::lossless;
  return to_document(image, options);
}

void expect_same_after_reading(const VectorImage& image) {
  const fs::path path = output("image.vtu");
  write_vtu(image, path);
  EXPECT_TRUE(bits_of(read_vtu(path)) == bits_of(image));
  EXPECT_TRUE(bits_of(import_image(path)) == bits_of(image));
}

VectorImage random_picture(std::uint32_t seed, bool opaque) {
  PatchMesh patches = testing::random_patches(6, 5, 53.3, 37.7, seed);
  for (int e = 0; e < patches.mesh.edge_count(); e += 3) {
    patches.mesh.edge_flags[e] |= e % 2 == 0 ? kFeatureEdge : kFeatureEdge | kTearEdge;
  }
  PatchMesh torn = straight_patches(patches.mesh);
  torn.edge_tangents = patches.edge_tangents;
  torn.opaque = opaque;
  testing::set_random_colors(torn, seed + 1, opaque);
  return single_layer(std::move(torn), 53.3, 37.7);
}

TEST(VtkRoundTrip, KeepsRandomTornPatchesBitForBit) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    expect_same_after_reading(random_picture(seed, seed % 2 == 0));
  }
}

TEST(VtkRoundTrip, KeepsLayersTransformsAndTexts) {
  VectorImage image = random_picture(3, false);
  image.layers.push_back(random_picture(4, true).layers[0]);
  image.layers[0].name = "";
  image.layers[1].name = "over \xc3\xa4 <&\"> \n";
  image.layers[1].transform = Eigen::Translation2d(53.3, 0.1) * Eigen::Scaling(-1.0 / 3, 0.7);
  image.metadata = {{"title", "a picture"}, {"empty", ""}, {"", "no key"}};
  expect_same_after_reading(image);
}

TEST(VtkRoundTrip, KeepsAPictureWithoutPatchesOrLayers) {
  VectorImage image = random_picture(3, true);
  image.layers.clear();
  expect_same_after_reading(image);
}

TEST(VtkRoundTrip, KeepsWedgesInAnyOrder) {
  VectorImage image = random_picture(5, true);
  PatchMesh& patches = image.layers[0].patches;
  const int last = static_cast<int>(patches.wedges.size()) - 1;
  std::reverse(patches.wedges.begin(), patches.wedges.end());
  for (int& w : patches.wedge_of_corner) w = last - w;
  expect_same_after_reading(image);
}

class HostileVtu : public ::testing::Test {
 protected:
  static const std::string& valid() {
    static const std::string bytes = [] {
      write_vtu(random_picture(7, false), output("valid.vtu"));
      std::ifstream file(output("valid.vtu"), std::ios::binary);
      return std::string{std::istreambuf_iterator<char>(file), {}};
    }();
    return bytes;
  }
  /// The error's code, or nothing when the file is read.
  static std::optional<ErrorCode> error_of(const std::string& bytes) {
    const fs::path path = output("hostile.vtu");
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      read_vtu(path);
      return std::nullopt;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("hostile.vtu"));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.code();
    }
  }
  static std::string replaced(const std::string& from, const std::string& to) {
    std::string bytes = valid();
    const auto at = bytes.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return bytes.replace(at, from.size(), to);
  }
};

TEST_F(HostileVtu, ForeignFilesAreNamedAsSuch) {
  for (const char* text : {"", "hello", "<VTKFile type=\"PolyData\"></VTKFile>"}) {
    EXPECT_EQ(error_of(text), ErrorCode::unsupported_format) << text;
  }
  EXPECT_EQ(error_of(replaced("quadrille_patches", "quadrille_catches")),
            ErrorCode::unsupported_format);
  EXPECT_THROW(read_vtu(output("absent.vtu")), Error);
}

TEST_F(HostileVtu, ImpossibleNumbersAreRefused) {
  for (const char* number : {"99999999999999", "-1", "", "1e9", "0x7fffffff"}) {
    const auto points = valid().find("NumberOfPoints=\"") + 16;
    std::string bytes = valid();
    bytes.replace(points, bytes.find('"', points) - points, number);
    EXPECT_EQ(error_of(bytes), ErrorCode::io_failure) << number;
  }
}

TEST_F(HostileVtu, MissingArraysAreRefused) {
  for (const char* name :
       {"\"corner_vertices\"", "\"corner_wedges\"", "\"layer\"", "\"picture_size\"",
        "\"layer0_vertices\"", "\"layer0_edge_flags\"", "\"layer0_edge_tangents\"",
        "\"layer0_wedges\"", "\"layer0_transform\"", "\"layer0_opaque\""}) {
    std::string other = name;
    other[1] = 'X';
    EXPECT_EQ(error_of(replaced(name, other)), ErrorCode::io_failure) << name;
  }
}

TEST_F(HostileVtu, TruncatedFilesAreRefused) {
  for (int i = 0; i < 40; ++i) {
    const std::size_t size = valid().size() * i / 40;
    EXPECT_NE(error_of(valid().substr(0, size)), std::nullopt) << size;
  }
}

TEST_F(HostileVtu, DamagedBytesAreRefusedOrChangeNothingThatCounts) {
  testing::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = valid();
    const int damages = random.integer(1, 4);
    for (int k = 0; k < damages; ++k) {
      bytes[random.integer(0, static_cast<int>(bytes.size()) - 1)] =
          static_cast<char>(random.integer(0, 255));
    }
    SCOPED_TRACE(i);
    error_of(bytes);
  }
}

/// Stores a file again by VTK's Python module.
int stored_again(const fs::path& from, const fs::path& to, const std::string& mode,
                 const std::string& move = "") {
  const std::string script = QUADRILLE_SOURCE_DIR "/tests/programs/resave_vtu.py";
  std::vector<std::string> command = {test::python_with_vtk(), script, from.string(), to.string(),
                                      mode};
  if (!move.empty()) command.push_back(move);
  return test::run(command);
}

TEST(VtkStoredAgain, IsReadAsBefore) {
  const VectorImage image = random_picture(8, false);
  write_vtu(image, output("first.vtu"));
  for (const char* mode : {"appended", "plain"}) {
    ASSERT_EQ(stored_again(output("first.vtu"), output("again.vtu"), mode), 0) << mode;
    EXPECT_TRUE(bits_of(read_vtu(output("again.vtu"))) == bits_of(image)) << mode;
  }
}

TEST(VtkStoredAgain, InAnotherFormIsRefusedWithAHint) {
  write_vtu(random_picture(8, false), output("first.vtu"));
  for (const char* mode : {"ascii", "binary"}) {
    ASSERT_EQ(stored_again(output("first.vtu"), output("again.vtu"), mode), 0) << mode;
    try {
      read_vtu(output("again.vtu"));
      FAIL() << mode << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::unsupported_format);
      EXPECT_THAT(error.what(), ::testing::HasSubstr("store it with raw appended data"));
    }
  }
}

TEST(VtkStoredAgain, IsRefusedWithAMovedPoint) {
  write_vtu(random_picture(8, false), output("first.vtu"));
  ASSERT_EQ(stored_again(output("first.vtu"), output("moved.vtu"), "appended", "0.5"), 0);
  try {
    read_vtu(output("moved.vtu"));
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::io_failure);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("points were changed"));
  }
}

}  // namespace
}  // namespace quadrille
