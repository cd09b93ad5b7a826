#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>

namespace quadrille {

/// A part of a ScratchFile.
struct ScratchRange {
  long long begin = 0, size = 0;
  bool empty() const { return size == 0; }
};

/// Bytes that wait on the disk until they are written where they belong: in a file without a name
/// beside the target, whose disk needs that room anyway. It is gone with the object or the process.
/// Throws Error{io_failure}.
class ScratchFile {
 public:
  using Bytes = std::span<const std::uint8_t>;

  explicit ScratchFile(const std::filesystem::path& target);
  void append(Bytes bytes);
  long long size() const { return size_; }
  /// Hands over the bytes of the range in parts of at most 16 KiB, all but the last of that size.
  void read(const ScratchRange& range, const std::function<void(Bytes)>& take);

 private:
  [[noreturn]] void fail(const char* what) const;

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path target_;
  std::unique_ptr<std::FILE, Close> file_;
  long long size_ = 0;
};

}  // namespace quadrille
