#pragma once

#include <cstddef>
#include <filesystem>

namespace quadrille::bench {

/// The file's size after gzip at its best level.
std::size_t gzip_size(const std::filesystem::path& path);

}  // namespace quadrille::bench
