#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace quadrille {

/// Estimates how often a binary decision is true, from those coded so far: the mean of the first
/// ones, later one that forgets.
class AdaptiveBit {
 public:
  /// Probability of true in 1 / 65536, never 0 or 1.
  std::uint32_t probability() const { return probability_; }
  void learn(bool value);

 private:
  std::uint16_t probability_ = 1 << 15;
  std::uint8_t seen_ = 0;
};

/// Binary arithmetic coding with 32-bit ranges (Martin, "Range encoding", 1979; carries as in the
/// LZMA format). Encoder and decoder have the same interface, so that one template describes both
/// directions: the encoder writes the value it is given, the decoder ignores that and reads one;
/// both return it.
class RangeEncoder {
 public:
  static constexpr bool kDecodes = false;
  /// A decision that is true with `probability` / 65536, which is never 0 or 1.
  bool decide(std::uint32_t probability, bool value);
  bool bit(AdaptiveBit& model, bool value) {
    decide(model.probability(), value);
    model.learn(value);
    return value;
  }
  /// `count` bits, at most 16, that are as often true as false.
  std::uint32_t even_bits(std::uint32_t value, int count);
  [[noreturn]] void refuse(const char* why) const;
  /// Ends the code; call once.
  std::vector<std::uint8_t> finish();

 private:
  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xffffffff;
  std::uint8_t pending_ = 0;
  std::size_t pending_count_ = 1;
  std::vector<std::uint8_t> bytes_;

  void shift_out();
};

class RangeDecoder {
 public:
  static constexpr bool kDecodes = true;
  /// `name` is used in messages; both must outlive the decoder.
  RangeDecoder(std::span<const std::uint8_t> bytes, const std::string& name);
  bool decide(std::uint32_t probability, bool = false);
  bool bit(AdaptiveBit& model, bool = false) {
    const bool value = decide(model.probability());
    model.learn(value);
    return value;
  }
  std::uint32_t even_bits(std::uint32_t, int count);
  /// Throws Error{io_failure}: the document is damaged.
  [[noreturn]] void refuse(const char* why) const;
  /// Refuses a code that does not end here.
  void finish() const;

 private:
  std::span<const std::uint8_t> bytes_;
  const std::string& name_;
  std::size_t next_ = 0;
  std::uint32_t code_ = 0, range_ = 0xffffffff;

  std::uint8_t next_byte();
};

/// Integers of either sign, small ones often: sign, bit length and the highest bits adapt.
class AdaptiveInteger {
 public:
  /// |value| < 2^30.
  template <class Coder>
  int code(Coder& coder, int value = 0) {
    if (!coder.bit(nonzero_, value != 0)) return 0;
    const bool negative = coder.bit(negative_, value < 0);
    const std::uint32_t magnitude =
        code_magnitude(coder, static_cast<std::uint32_t>(value < 0 ? -value : value));
    return negative ? -static_cast<int>(magnitude) : static_cast<int>(magnitude);
  }

 private:
  static constexpr int kMostBits = 30;
  AdaptiveBit nonzero_, negative_;
  std::array<AdaptiveBit, kMostBits> longer_;
  std::array<std::array<AdaptiveBit, 8>, kMostBits> high_;  // the bits below the leading one

  template <class Coder>
  std::uint32_t code_magnitude(Coder& coder, std::uint32_t magnitude) {
    int bits = 0;  // below the leading one
    while (coder.bit(longer_[bits], (magnitude >> bits) > 1)) {
      if (++bits == kMostBits) coder.refuse("a number is too large");
    }
    std::uint32_t value = 1;
    int left = bits;
    for (; left > 0 && value < 8; --left) {
      AdaptiveBit& model = high_[bits][value];
      value = value << 1 | (coder.bit(model, magnitude >> (left - 1) & 1) ? 1u : 0u);
    }
    while (left > 0) {
      const int count = left < 16 ? left : 16;
      left -= count;
      const std::uint32_t low = (magnitude >> left) & ((1u << count) - 1);
      value = value << count | coder.even_bits(low, count);
    }
    return value;
  }
};

}  // namespace quadrille
