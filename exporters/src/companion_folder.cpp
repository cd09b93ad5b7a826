#include "companion_folder.h"

#include "quadrille/error.h"

namespace quadrille {
namespace fs = std::filesystem;
namespace {

fs::path folder_of(fs::path file, const std::string& suffix) {
  file.replace_extension();
  return file += suffix;
}

}  // namespace

CompanionFolder::CompanionFolder(const fs::path& temporary, const fs::path& target,
                                 const std::string& suffix)
    : from_(folder_of(temporary, suffix)), to_(folder_of(target, suffix)) {
  std::error_code error;
  const fs::file_status status = fs::status(to_, error);
  if (!fs::status_known(status)) {
    throw Error(ErrorCode::io_failure, "cannot write '" + target.string() + "': its folder '" +
                                           to_.string() + "' cannot be made (" + error.message() +
                                           "); choose another name");
  }
  const bool is_folder = fs::is_directory(status), is_obstacle = fs::exists(status) && !is_folder;
  if (is_obstacle || (is_folder && !fs::exists(target, error))) {
    throw Error(ErrorCode::io_failure,
                "cannot write '" + target.string() + "': '" + to_.string() + "' is " +
                    (is_obstacle ? "no folder, and parts of it have to lie in one of that name"
                                 : "there already and belongs to no such file") +
                    "; move it or choose another name");
  }
}

CompanionFolder::~CompanionFolder() {
  std::error_code ignored;
  fs::remove_all(from_, ignored);
}

void CompanionFolder::keep() const {
  std::error_code error;
  fs::remove_all(to_, error);
  if (!error) fs::rename(from_, to_, error);
  if (error) {
    throw Error(ErrorCode::io_failure, "cannot write '" + to_.string() + "': " + error.message() +
                                           "; choose another path");
  }
}

}  // namespace quadrille
