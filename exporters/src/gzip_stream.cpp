#include "gzip_stream.h"

#include "quadrille/error.h"

namespace quadrille {

GzipBuffer::GzipBuffer(std::ostream& out) : out_(out) {
  constexpr int kGzipWindow = 15 + 16;  // the largest window, in a gzip wrapper
  if (deflateInit2(&stream_, Z_BEST_COMPRESSION, Z_DEFLATED, kGzipWindow, 9, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw Error(ErrorCode::limit_exceeded, "no memory to compress the file");
  }
  setp(pending_.data(), pending_.data() + pending_.size());
}

GzipBuffer::~GzipBuffer() { deflateEnd(&stream_); }

GzipBuffer::int_type GzipBuffer::overflow(int_type c) {
  deflate_pending(Z_NO_FLUSH);
  if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
  return traits_type::not_eof(c);
}

void GzipBuffer::deflate_pending(int flush) {
  stream_.next_in = reinterpret_cast<Bytef*>(pbase());
  stream_.avail_in = static_cast<uInt>(pptr() - pbase());
  do {
    stream_.next_out = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_out = static_cast<uInt>(packed_.size());
    deflate(&stream_, flush);
    out_.write(packed_.data(), static_cast<std::streamsize>(packed_.size() - stream_.avail_out));
  } while (stream_.avail_out == 0);
  setp(pending_.data(), pending_.data() + pending_.size());
}

}  // namespace quadrille
