#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "quadrille/error.h"

namespace quadrille::bench {

/// An empty folder that goes away, with all that is in it, at the end of its scope.
class ScratchFolder {
 public:
  ScratchFolder() {
    const auto parent = std::filesystem::temp_directory_path();
    std::string pattern = (parent / "quadrille_bench_XXXXXX").string();
    if (!mkdtemp(pattern.data())) {
      throw Error(ErrorCode::io_failure, "cannot make a folder in '" + parent.string() +
                                             "'; free some space there, or set TMPDIR");
    }
    path = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path path;
};

}  // namespace quadrille::bench
