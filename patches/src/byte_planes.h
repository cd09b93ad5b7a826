#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace quadrille {

/// The elements of an array as consecutive unsigned words.
template <class Word, class Element>
std::vector<Word> words_of(const std::vector<Element>& elements) {
  static_assert(sizeof(Element) % sizeof(Word) == 0);
  std::vector<Word> words(elements.size() * (sizeof(Element) / sizeof(Word)));
  if (!words.empty()) std::memcpy(words.data(), elements.data(), words.size() * sizeof(Word));
  return words;
}

template <class Element, class Word>
std::vector<Element> elements_of(const std::vector<Word>& words) {
  static_assert(sizeof(Element) % sizeof(Word) == 0);
  std::vector<Element> elements(words.size() / (sizeof(Element) / sizeof(Word)));
  if (!words.empty()) {
    std::memcpy(static_cast<void*>(elements.data()), words.data(), words.size() * sizeof(Word));
  }
  return elements;
}

/// Separates the bytes of words by component and significance, least significant first. Similar
/// bytes (signs, exponents, high bytes of indices) become neighbours, which compresses well.
template <class Word>
std::vector<std::uint8_t> split_planes(std::span<const Word> words, std::size_t components) {
  static_assert(std::is_unsigned_v<Word>);
  const std::size_t count = words.size() / components;
  std::vector<std::uint8_t> planes(words.size_bytes());
  std::uint8_t* out = planes.data();
  for (std::size_t c = 0; c < components; ++c) {
    for (std::size_t b = 0; b < sizeof(Word); ++b) {
      for (std::size_t i = 0; i < count; ++i) {
        *out++ = static_cast<std::uint8_t>(words[i * components + c] >> (8 * b));
      }
    }
  }
  return planes;
}

/// The inverse of split_planes(). The size must be a multiple of sizeof(Word) * components.
template <class Word>
std::vector<Word> join_planes(std::span<const std::uint8_t> planes, std::size_t components) {
  static_assert(std::is_unsigned_v<Word>);
  std::vector<Word> words(planes.size() / sizeof(Word));
  const std::size_t count = words.size() / components;
  const std::uint8_t* in = planes.data();
  for (std::size_t c = 0; c < components; ++c) {
    for (std::size_t b = 0; b < sizeof(Word); ++b) {
      for (std::size_t i = 0; i < count; ++i) {
        words[i * components + c] |= static_cast<Word>(*in++) << (8 * b);
      }
    }
  }
  return words;
}

/// Small differences of either sign become small numbers: 0, -1, 1, -2, ... to 0, 1, 2, 3, ...
/// Wraps around, so that every pair of words comes back.
inline std::uint32_t zigzag_difference(std::uint32_t value, std::uint32_t from) {
  const std::uint32_t d = value - from;
  return (d << 1) ^ (0u - (d >> 31));
}

inline std::uint32_t undo_zigzag_difference(std::uint32_t coded, std::uint32_t from) {
  return from + ((coded >> 1) ^ (0u - (coded & 1)));
}

}  // namespace quadrille
