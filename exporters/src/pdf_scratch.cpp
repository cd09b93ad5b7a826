#include "pdf_scratch.h"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

#include "quadrille/atomic_file.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

std::FILE* open_scratch(const std::filesystem::path& target) {
  const std::filesystem::path name = temporary_beside(target);
  std::FILE* const file = std::fopen(name.c_str(), "w+bx");
  std::error_code ignored;
  if (file) std::filesystem::remove(name, ignored);  // the open file stays
  return file;
}

}  // namespace

ScratchFile::ScratchFile(const std::filesystem::path& target)
    : target_(target),
      file_(open_scratch(std::filesystem::weakly_canonical(std::filesystem::absolute(target)))) {
  if (!file_) fail("made");
}

void ScratchFile::fail(const char* what) const {
  throw Error(ErrorCode::io_failure,
              "cannot write '" + target_.string() + "': a temporary file beside it cannot be " +
                  what + "; check the free space of the disk or choose another path");
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
