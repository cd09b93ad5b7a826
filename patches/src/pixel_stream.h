#pragma once

#include <cstddef>

namespace quadrille {

/// Copies `height` rows of `width` bytes to memory that will not be read soon: past the caches,
/// which saves reading what is written over.
void stream_rows(const std::byte* from, std::ptrdiff_t from_stride, int width, int height,
                 std::byte* to, std::ptrdiff_t to_stride);

}  // namespace quadrille
