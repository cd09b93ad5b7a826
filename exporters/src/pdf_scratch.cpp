#include "pdf_scratch.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>

#include "quadrille/error.h"

namespace quadrille {
namespace {

int open_nameless(const std::filesystem::path& folder) {
#ifdef O_TMPFILE
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0) return file;
#endif
  // Not every file system knows files without names.
  std::string name = folder / ".quadrille-XXXXXX";
  const int named = ::mkstemp(name.data());
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

std::FILE* open_scratch(const std::filesystem::path& folder) {
  const int file = open_nameless(folder);
  if (file < 0) return nullptr;
  std::FILE* const stream = ::fdopen(file, "w+b");
  if (!stream) ::close(file);
  return stream;
}

}  // namespace

ScratchFile::ScratchFile(const std::filesystem::path& target)
    : folder_(std::filesystem::weakly_canonical(std::filesystem::absolute(target)).parent_path()),
      file_(open_scratch(folder_)) {
  if (!file_) fail("made");
}

void ScratchFile::fail(const char* what) const {
  throw Error(ErrorCode::io_failure,
              std::string("a temporary file in '") + folder_.string() + "' cannot be " + what +
                  "; check the free space of the disk or choose another path");
}

void ScratchFile::append(Bytes bytes) {
  if (std::fseek(file_.get(), 0, SEEK_END) != 0 ||
      std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
    fail("written");
  }
  size_ += static_cast<long long>(bytes.size());
}

void ScratchFile::read(const ScratchRange& range, const std::function<void(Bytes)>& take) {
  std::array<std::uint8_t, 16384> buffer;
  if (std::fflush(file_.get()) != 0) fail("written");
  if (std::fseek(file_.get(), range.begin, SEEK_SET) != 0) fail("read");
  for (long long left = range.size; left > 0;) {
    const auto part = static_cast<std::size_t>(std::min<long long>(left, buffer.size()));
    if (std::fread(buffer.data(), 1, part, file_.get()) != part) fail("read");
    take({buffer.data(), part});
    left -= static_cast<long long>(part);
  }
}

}  // namespace quadrille
