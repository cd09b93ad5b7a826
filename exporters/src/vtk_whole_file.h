#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace quadrille {

/// The bytes of a regular file. Throws Error{io_failure} saying whether it is missing, a folder,
/// something else than a file, or closed to us, and Error{limit_exceeded}, before any byte is read,
/// when there are more than `most_bytes`.
std::string read_whole(const std::filesystem::path& path,
                       std::uintmax_t most_bytes = std::numeric_limits<std::uintmax_t>::max());

}  // namespace quadrille
