#pragma once

#include <cstdint>

namespace quadrille {

/// Bits begin ... end - 1, where 0 <= begin <= end <= 32.
inline std::uint32_t bit_range(int begin, int end) {
  return static_cast<std::uint32_t>((std::uint64_t{1} << end) - (std::uint64_t{1} << begin));
}

}  // namespace quadrille
