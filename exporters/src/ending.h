#pragma once

#include <filesystem>
#include <string>

namespace quadrille {

/// The ending of the path with the dot, ASCII letters in lower case.
std::string lower_case_ending(const std::filesystem::path& path);

}  // namespace quadrille
