#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace quadrille {

/// The name of a file that is not there, in the folder of `target` and with its ending, by which
/// many writers choose the format.
std::filesystem::path temporary_beside(const std::filesystem::path& target);

/// Calls `write` with the path of a temporary beside `target` that has the same file ending, and
/// renames it over the target when `write` returns. When `write` throws, or the rename fails, the
/// temporary is removed and the target is left as it was.
/// A symbolic link as target is followed. Throws Error{io_failure} when the folder does not exist
/// or cannot be written, or the target is something else than a file, besides whatever `write`
/// throws.
void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for a binary stream: throws Error{io_failure} too when the bytes did not all arrive.
void write_stream_atomically(const std::filesystem::path& target,
                             const std::function<void(std::ostream& file)>& write);

}  // namespace quadrille
