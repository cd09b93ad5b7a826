#pragma once

#include <zlib.h>

#include <array>
#include <ostream>
#include <streambuf>

namespace quadrille {

/// Compresses what is written to it into a gzip file (RFC 1952) on another stream: without name and
/// time, so that equal text gives equal bytes. finish() ends the file.
class GzipBuffer : public std::streambuf {
 public:
  explicit GzipBuffer(std::ostream& out);
  ~GzipBuffer() override;
  GzipBuffer(const GzipBuffer&) = delete;
  GzipBuffer& operator=(const GzipBuffer&) = delete;
  void finish() { deflate_pending(Z_FINISH); }

 protected:
  int_type overflow(int_type c) override;

 private:
  void deflate_pending(int flush);

  std::ostream& out_;
  z_stream stream_{};
  std::array<char, 1 << 16> pending_, packed_;
};

}  // namespace quadrille
