#include "quadrille/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "quadrille/error.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

class AtomicFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("quadrille_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  auto entries() const { return std::distance(fs::directory_iterator(folder_), {}); }

  fs::path folder_;
};

TEST_F(AtomicFile, ReplacesTheTargetByATemporaryWithTheSameEnding) {
  const fs::path target = folder_ / "a.svg";
  write_text(target, "old");
  write_atomically(target, [&](const fs::path& temporary) {
    EXPECT_EQ(temporary.extension(), ".svg");
    EXPECT_EQ(temporary.parent_path(), folder_);
    EXPECT_NE(temporary, target);
    EXPECT_EQ(text_of(target), "old");
    write_text(temporary, "new");
  });
  EXPECT_EQ(text_of(target), "new");
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFile, LeavesTheTargetWhenWritingFails) {
  const fs::path target = folder_ / "a.svg";
  write_text(target, "old");
  EXPECT_THROW(write_atomically(target,
                                [](const fs::path& temporary) {
                                  write_text(temporary, "half");
                                  throw std::runtime_error("stop");
                                }),
               std::runtime_error);
  EXPECT_EQ(text_of(target), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFile, NamesTheMissingFolder) {
  bool called = false;
  try {
    write_atomically(folder_ / "x" / "y.svg", [&](const fs::path&) { called = true; });
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::io_failure);
    EXPECT_THAT(error.what(), testing::HasSubstr("y.svg': the folder does not exist; create it"));
  }
  EXPECT_FALSE(called);
}

TEST_F(AtomicFile, RefusesFoldersAndFilesUsedAsFolders) {
  const auto nothing = [](const fs::path&) {};
  write_text(folder_ / "file", "");
  EXPECT_THROW(write_atomically(folder_, nothing), Error);
  EXPECT_THROW(write_atomically(folder_ / "file" / "a.svg", nothing), Error);
  EXPECT_THROW(write_atomically("", nothing), Error);
}

TEST_F(AtomicFile, ReportsAWriterThatWroteNothing) {
  EXPECT_THROW(write_atomically(folder_ / "a.svg", [](const fs::path&) {}), Error);
  EXPECT_EQ(entries(), 0);
}

}  // namespace
}  // namespace quadrille
