#pragma once

#include <filesystem>
#include <functional>

namespace quadrille {

/// Calls `write` with the path of a temporary beside `target` that has the same file ending, and
/// renames it over the target when `write` returns. When `write` throws, or the rename fails, the
/// temporary is removed and the target is left as it was.
/// Throws Error{io_failure} when the folder does not exist or cannot be written, besides whatever
/// `write` throws.
void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

}  // namespace quadrille
