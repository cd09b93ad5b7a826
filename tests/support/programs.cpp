#include "support/programs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

namespace quadrille::test {
namespace {

class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("quadrille-test-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!::testing::UnitTest::GetInstance()->Failed()) {
      std::filesystem::remove_all(path_, ignored);
    }
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

std::filesystem::path scratch_dir() {
  ::testing::UnitTest::GetInstance();  // outlives the folder, whose end asks it for failures
  static const ScratchFolder folder;
  return folder.path();
}

}  // namespace quadrille::test
