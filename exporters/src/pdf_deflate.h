#pragma once

#include <zlib.h>

#include <cstdint>
#include <span>
#include <string>

namespace quadrille {

/// Compresses bytes as they come: PNG's "Up" prediction from the record before, then deflate, as
/// /FlateDecode with /Predictor 12 and /Columns `record_bytes` reads it.
class RecordDeflater {
 public:
  explicit RecordDeflater(int record_bytes);
  ~RecordDeflater();
  RecordDeflater(const RecordDeflater&) = delete;
  RecordDeflater& operator=(const RecordDeflater&) = delete;

  void add(std::span<const std::uint8_t> bytes);
  /// Ends the stream and returns it. What was added must fill whole rows of `record_bytes`.
  std::string finish();

 private:
  void end_row();

  z_stream stream_{};
  std::string row_, above_, compressed_;
  std::size_t row_bytes_;
};

}  // namespace quadrille
