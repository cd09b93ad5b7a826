#include "document_range_coder.h"

#include "document_container.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

constexpr std::uint32_t kLowestRange = 1 << 24;
/// After so many decisions an estimate stops slowing down.
constexpr int kMemory = 120;
/// Keeps every decision possible.
constexpr std::int32_t kLeast = 48, kMost = 65536 - kLeast;

/// 2^16 / (n + 1.5): the step of a running mean that starts from one half with the weight of half a
/// decision.
constexpr std::array<std::int32_t, kMemory + 1> kSteps = [] {
  std::array<std::int32_t, kMemory + 1> steps{};
  for (int n = 0; n <= kMemory; ++n) steps[n] = (1 << 17) / (2 * n + 3);
  return steps;
}();

}  // namespace

void AdaptiveBit::learn(bool value) {
  const std::int32_t target = value ? kMost : kLeast;
  const std::int32_t error = target - probability_;
  probability_ = static_cast<std::uint16_t>(probability_ + error * kSteps[seen_] / (1 << 16));
  if (seen_ < kMemory) ++seen_;
}

bool RangeEncoder::decide(std::uint32_t probability, bool value) {
  const std::uint32_t bound = (range_ >> 16) * probability;
  if (value) {
    range_ = bound;
  } else {
    low_ += bound;
    range_ -= bound;
  }
  while (range_ < kLowestRange) {
    range_ <<= 8;
    shift_out();
  }
  return value;
}

std::uint32_t RangeEncoder::even_bits(std::uint32_t value, int count) {
  range_ >>= count;
  low_ += std::uint64_t{range_} * value;
  while (range_ < kLowestRange) {
    range_ <<= 8;
    shift_out();
  }
  return value;
}

/// A byte is held back until no carry can reach it; of a run of 0xff only the length is kept.
void RangeEncoder::shift_out() {
  if (low_ < 0xff000000u || low_ > 0xffffffffu) {
    const auto carry = static_cast<std::uint8_t>(low_ >> 32);
    for (; pending_count_ > 0; --pending_count_) {
      bytes_.push_back(static_cast<std::uint8_t>(pending_ + carry));
      pending_ = 0xff;
    }
    pending_ = static_cast<std::uint8_t>(low_ >> 24);
  }
  ++pending_count_;
  low_ = (low_ & 0x00ffffffu) << 8;
}

void RangeEncoder::refuse(const char* why) const {
  throw Error(ErrorCode::limit_exceeded,
              std::string("the document cannot be written (") + why + "); use the lossless mode");
}

std::vector<std::uint8_t> RangeEncoder::finish() {
  for (int i = 0; i < 5; ++i) shift_out();
  return std::move(bytes_);
}

RangeDecoder::RangeDecoder(std::span<const std::uint8_t> bytes, const std::string& name)
    : bytes_(bytes), name_(name) {
  for (int i = 0; i < 5; ++i) code_ = code_ << 8 | next_byte();  // the first one is always 0
}

bool RangeDecoder::decide(std::uint32_t probability, bool) {
  const std::uint32_t bound = (range_ >> 16) * probability;
  const bool value = code_ < bound;
  if (value) {
    range_ = bound;
  } else {
    code_ -= bound;
    range_ -= bound;
  }
  while (range_ < kLowestRange) {
    range_ <<= 8;
    code_ = code_ << 8 | next_byte();
  }
  return value;
}

std::uint32_t RangeDecoder::even_bits(std::uint32_t, int count) {
  range_ >>= count;
  std::uint32_t value = code_ / range_;
  const std::uint32_t most = (1u << count) - 1;
  if (value > most) value = most;  // only in damaged code
  code_ -= range_ * value;
  while (range_ < kLowestRange) {
    range_ <<= 8;
    code_ = code_ << 8 | next_byte();
  }
  return value;
}

void RangeDecoder::refuse(const char* why) const { report_damaged_document(name_, why); }

void RangeDecoder::finish() const {
  if (next_ != bytes_.size()) refuse("a code is too long");
}

std::uint8_t RangeDecoder::next_byte() {
  if (next_ == bytes_.size()) refuse("a code ends too early");
  return bytes_[next_++];
}

}  // namespace quadrille
