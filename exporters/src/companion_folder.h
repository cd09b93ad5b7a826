#pragma once

#include <filesystem>
#include <string>

namespace quadrille {

/// A folder that belongs to a file, named like it but with `suffix` in place of the ending. While
/// the file is a temporary, so is the folder: the destructor removes it, keep() moves it to its
/// place beside the target, over that of a former file.
class CompanionFolder {
 public:
  /// Throws Error{io_failure} when the target's folder is there but the target is not, since then
  /// it belongs to something else, and when something else than a folder has its name.
  CompanionFolder(const std::filesystem::path& temporary, const std::filesystem::path& target,
                  const std::string& suffix);
  ~CompanionFolder();
  CompanionFolder(const CompanionFolder&) = delete;
  CompanionFolder& operator=(const CompanionFolder&) = delete;

  const std::filesystem::path& temporary() const { return from_; }
  const std::filesystem::path& target() const { return to_; }
  void keep() const;

 private:
  std::filesystem::path from_, to_;
};

}  // namespace quadrille
