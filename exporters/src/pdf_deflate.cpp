#include "pdf_deflate.h"

#include <algorithm>
#include <new>

namespace quadrille {
namespace {

constexpr int kBestCompression = 9;
constexpr char kUp = 2;

void run(z_stream& stream, std::span<const std::uint8_t> bytes, int flush, ScratchFile& out) {
  std::uint8_t buffer[16384];
  stream.next_in = const_cast<std::uint8_t*>(bytes.data());
  stream.avail_in = static_cast<unsigned>(bytes.size());
  do {
    stream.next_out = buffer;
    stream.avail_out = sizeof buffer;
    ::deflate(&stream, flush);
    out.append({buffer, sizeof buffer - stream.avail_out});
  } while (stream.avail_out == 0);
}

}  // namespace

RecordDeflater::RecordDeflater(int record_bytes, ScratchFile& out)
    : out_(out), begin_(out.size()), above_(record_bytes, '\0'), row_bytes_(record_bytes) {
  if (deflateInit(&stream_, kBestCompression) != Z_OK) throw std::bad_alloc();
}

RecordDeflater::~RecordDeflater() { deflateEnd(&stream_); }

void RecordDeflater::add(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::size_t taken = std::min(row_bytes_ - row_.size(), bytes.size());
    row_.append(reinterpret_cast<const char*>(bytes.data()), taken);
    bytes = bytes.subspan(taken);
    if (row_.size() == row_bytes_) end_row();
  }
}

void RecordDeflater::end_row() {
  std::string predicted(1 + row_bytes_, kUp);
  for (std::size_t i = 0; i < row_bytes_; ++i) {
    predicted[i + 1] = static_cast<char>(row_[i] - above_[i]);
  }
  above_.swap(row_);
  row_.clear();
  run(stream_, {reinterpret_cast<const std::uint8_t*>(predicted.data()), predicted.size()},
      Z_NO_FLUSH, out_);
}

ScratchRange RecordDeflater::finish() {
  run(stream_, {}, Z_FINISH, out_);
  return {begin_, out_.size() - begin_};
}

}  // namespace quadrille
