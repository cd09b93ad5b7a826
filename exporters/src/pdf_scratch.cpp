#include "pdf_scratch.h"

#include <algorithm>
#include <array>

#include "quadrille/error.h"

namespace quadrille {
namespace {

[[noreturn]] void fail(const char* what) {
  throw Error(ErrorCode::io_failure,
              std::string("a temporary file cannot be ") + what +
                  "; check the free space and the permissions of the folder for temporary files");
}

}  // namespace

ScratchFile::ScratchFile() : file_(std::tmpfile()) {
  if (!file_) fail("made");
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
  if (std::fseek(file_.get(), range.begin, SEEK_SET) != 0) fail("read");
  for (long long left = range.size; left > 0;) {
    const auto part = static_cast<std::size_t>(std::min<long long>(left, buffer.size()));
    if (std::fread(buffer.data(), 1, part, file_.get()) != part) fail("read");
    take({buffer.data(), part});
    left -= static_cast<long long>(part);
  }
}

}  // namespace quadrille
