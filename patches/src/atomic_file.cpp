#include "quadrille/atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "quadrille/error.h"

namespace quadrille {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse(const fs::path& target, const std::string& why) {
  throw Error(ErrorCode::io_failure, "cannot write '" + target.string() + "': " + why);
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

void check_writable(const fs::path& target) {
  if (!target.has_filename()) refuse(target, "it names no file; add a file name");
  std::error_code ignored;
  const fs::path folder = folder_of(target);
  if (!fs::exists(folder, ignored)) {
    refuse(target, "the folder does not exist; create it or choose another path");
  }
  if (!fs::is_directory(folder, ignored)) {
    refuse(target, "'" + folder.string() + "' is not a folder; choose another path");
  }
  if (fs::is_directory(target, ignored)) {
    refuse(target, "it is a folder; add a file name");
  }
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    refuse(target, "it is not a regular file; choose another path");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    refuse(target, std::string("the folder is not writable (") + std::strerror(errno) +
                       "); change its permissions or choose another path");
  }
}

class RemovedUnlessKept {
 public:
  explicit RemovedUnlessKept(const fs::path& path) : path_(path) {}
  ~RemovedUnlessKept() {
    std::error_code ignored;
    if (!kept_) fs::remove(path_, ignored);
  }
  RemovedUnlessKept(const RemovedUnlessKept&) = delete;
  RemovedUnlessKept& operator=(const RemovedUnlessKept&) = delete;
  void keep() { kept_ = true; }

 private:
  const fs::path& path_;
  bool kept_ = false;
};

}  // namespace

/// Unique among processes by the process id and among threads by the counter.
fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  std::string name = ".quadrille-";
  name += std::to_string(::getpid()) + '-' + std::to_string(counter++);
  name += target.extension().string();
  return folder_of(target) / name;
}

void write_atomically(const fs::path& named,
                      const std::function<void(const fs::path& temporary)>& write) {
  std::error_code error;
  const fs::path target = fs::is_symlink(named, error) ? fs::weakly_canonical(named, error) : named;
  if (target.empty() && error) refuse(named, error.message() + "; choose another path");
  check_writable(target);
  const fs::path temporary = temporary_beside(target);
  RemovedUnlessKept guard(temporary);
  write(temporary);
  fs::rename(temporary, target, error);
  if (error) refuse(target, error.message() + "; choose another path");
  guard.keep();
}

void write_stream_atomically(const fs::path& target,
                             const std::function<void(std::ostream& file)>& write) {
  write_atomically(target, [&](const fs::path& temporary) {
    std::ofstream file(temporary, std::ios::binary);
    if (!file) refuse(target, "the folder takes no new file; choose another path");
    write(file);
    file.close();
    if (!file) refuse(target, "not all bytes arrived; check the free space of the disk");
  });
}

}  // namespace quadrille
