#pragma once

#include <filesystem>
#include <string>

namespace quadrille {

/// The bytes of a file. Throws Error{io_failure} saying whether it is missing, a folder, or closed
/// to us.
std::string read_whole(const std::filesystem::path& path);

}  // namespace quadrille
