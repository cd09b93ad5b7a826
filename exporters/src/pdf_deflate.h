#pragma once

#include <zlib.h>

#include <cstdint>
#include <span>
#include <string>

#include "pdf_scratch.h"

namespace quadrille {

/// Compresses bytes as they come: PNG's "Up" prediction from the record before, then deflate, as
/// /FlateDecode with /Predictor 12 and /Columns `record_bytes` reads it; into a scratch file, which
/// nobody else may write to meanwhile.
class RecordDeflater {
 public:
  RecordDeflater(int record_bytes, ScratchFile& out);
  ~RecordDeflater();
  RecordDeflater(const RecordDeflater&) = delete;
  RecordDeflater& operator=(const RecordDeflater&) = delete;

  void add(std::span<const std::uint8_t> bytes);
  /// Ends the stream and tells where it is. What was added must fill whole rows of `record_bytes`.
  ScratchRange finish();

 private:
  void end_row();

  z_stream stream_{};
  ScratchFile& out_;
  long long begin_;
  std::string row_, above_;
  std::size_t row_bytes_;
};

}  // namespace quadrille
