#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "quadrille/error.h"
#include "quadrille/export.h"
#include "support/programs.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

fs::path output(const std::string& name) { return test::scratch_dir() / name; }

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

VectorImage picture() {
  PatchMesh patches = testing::random_patches(9, 6, 144, 96, 3);
  testing::set_random_colors(patches, 5);
  return testing::single_layer(std::move(patches), 144, 96);
}

std::uintmax_t size_of(const std::string& name, const SvgOptions& options = {}) {
  write_svg(picture(), output(name), options);
  return fs::file_size(output(name));
}

TEST(SvgSize, GrowsFromLevelToLevel) {
  SvgOptions options;
  options.level = SvgLevel::compact;
  const std::uintmax_t compact = size_of("level.svg", options);
  const std::uintmax_t balanced = size_of("level.svg");
  options.level = SvgLevel::faithful;
  EXPECT_LT(compact, balanced);
  EXPECT_LT(balanced, size_of("level.svg", options));
}

TEST(SvgSize, SvgzIsTheSameTextCompressed) {
  const std::uintmax_t plain = size_of("packed.svg");
  EXPECT_LT(size_of("packed.svgz"), plain / 2);
  std::string unpacked;
  ASSERT_EQ(test::run({"gzip", "-dcS", "z", output("packed.svgz")}, &unpacked), 0) << unpacked;
  EXPECT_EQ(unpacked, bytes_of(output("packed.svg")));
}

TEST(SvgSize, SvgzHoldsNeitherTimeNorName) {
  size_of("when.svgz");
  const std::string bytes = bytes_of(output("when.svgz"));
  // Magic number, deflate, no flags, no time (RFC 1952).
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x1f\x8b\x08\0\0\0\0\0", 8));
}

TEST(SvgSize, ALimitIsKeptAndUsed) {
  for (const char* name : {"limit.svg", "limit.svgz"}) {
    SvgOptions options;
    options.level = SvgLevel::compact;
    const std::uintmax_t whole = size_of(name, options);
    options.size_limit = whole * 7 / 10;
    const std::uintmax_t limited = size_of(name, options);
    EXPECT_LE(limited, options.size_limit) << name;
    EXPECT_GT(limited, options.size_limit / 2) << name;
    const std::string first = bytes_of(output(name));
    size_of(name, options);
    EXPECT_EQ(first, bytes_of(output(name)));
  }
}

TEST(SvgSize, ALimitThatDoesNotBindChangesNothing) {
  size_of("free.svg");
  const std::string free = bytes_of(output("free.svg"));
  SvgOptions options;
  options.size_limit = free.size();
  size_of("free.svg", options);
  EXPECT_EQ(bytes_of(output("free.svg")), free);
}

TEST(SvgSize, ALimitThatCannotBeKeptIsRefused) {
  SvgOptions options;
  options.size_limit = 1000;
  try {
    write_svg(picture(), output("never.svg"), options);
    FAIL() << "was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::limit_exceeded);
    EXPECT_THAT(error.what(), HasSubstr("above the limit of 1 KB"));
  }
  EXPECT_FALSE(fs::exists(output("never.svg")));
}

}  // namespace
}  // namespace quadrille
