#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "document_container.h"

namespace quadrille::testing {

/// Damaged documents, made of good ones: bytes changed, cut off, moved or exchanged between two of
/// them, in the file or in the content inside its zstd frame. Reproducible.
class DocumentFuzz {
 public:
  using Bytes = std::vector<std::byte>;

  DocumentFuzz(std::vector<Bytes> good, std::uint32_t seed)
      : good_(std::move(good)), random_(seed) {
    for (const Bytes& bytes : good_) content_.push_back(unpack_document(bytes, "good").content);
  }

  Bytes next() {
    const std::size_t a = below(good_.size()), b = below(good_.size());
    if (below(4) == 0) return mutated(good_[a], good_[b]);
    // Inside the frame, where only our own checks are.
    const std::uint32_t version = below(8) == 0                 ? 1 + below(2)
                                  : good_[a][8] == std::byte{1} ? 1
                                                                : 2;
    return pack_document(mutated(content_[a], content_[b]), version, kQuads);
  }

 private:
  static constexpr std::uint64_t kQuads = 4096;  // that the file's size allows to claim
  std::vector<Bytes> good_;
  std::vector<std::vector<std::uint8_t>> content_;
  std::mt19937 random_;

  std::size_t below(std::size_t n) { return n > 0 ? random_() % n : 0; }

  template <class Byte>
  std::vector<Byte> mutated(std::vector<Byte> bytes, const std::vector<Byte>& other) {
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(bytes, other);
    return bytes;
  }

  template <class Byte>
  void change(std::vector<Byte>& bytes, const std::vector<Byte>& other) {
    if (bytes.empty()) return;
    const std::size_t at = below(bytes.size());
    switch (below(8)) {
      case 0:
      case 1:
        bytes[at] = static_cast<Byte>(random_());
        return;
      case 2:
        bytes[at] = bytes[at] ^ static_cast<Byte>(1u << below(8));
        return;
      case 3: {  // a word: sizes, counts and offsets
        const std::uint32_t words[] = {
            0, 1, 0x7fffffff, 0xffffffff, 0x80000000, 255, static_cast<std::uint32_t>(random_())};
        const std::uint32_t word = words[below(7)];
        const std::size_t aligned = at & ~std::size_t{3};
        std::memcpy(bytes.data() + aligned, &word,
                    std::min<std::size_t>(4, bytes.size() - aligned));
        return;
      }
      case 4:
        if (below(4) == 0) bytes.resize(at);
        return;
      case 5: {  // a run of zeros or of the largest byte
        const std::size_t end = std::min(bytes.size(), at + below(64));
        std::fill(bytes.begin() + at, bytes.begin() + end, static_cast<Byte>(below(2) ? 0 : 255));
        return;
      }
      case 6: {  // from the other one
        const std::size_t from = below(other.size()),
                          most = std::min(bytes.size() - at, other.size() - from);
        std::copy_n(other.begin() + from, below(most + 1), bytes.begin() + at);
        return;
      }
      default: {  // the head of one and the tail of the other
        if (below(4) != 0) return;
        bytes.resize(at);
        bytes.insert(bytes.end(), other.begin() + below(other.size()), other.end());
      }
    }
  }
};

}  // namespace quadrille::testing
