#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "quadrille/vector_image.h"

namespace quadrille {

/// The native document `.quad`: a FlatBuffers table compressed by zstd, lossless. Loading verifies
/// everything before use: sizes and offsets, index ranges, adjacency, finite numbers.

/// Never fails on a valid image; the same image gives the same bytes.
std::vector<std::byte> to_document(const VectorImage& image);
/// Throws Error{unsupported_format} for a foreign file or a newer format version, and
/// Error{io_failure} for a damaged one; Error{limit_exceeded} for one that would unpack to more
/// than 4 GiB. `name` is used in messages.
VectorImage from_document(std::span<const std::byte> bytes, const std::string& name = "document");

/// Written to a temporary beside the target and renamed. Throws Error{io_failure}.
void save_document(const VectorImage& image, const std::filesystem::path& path);
VectorImage load_document(const std::filesystem::path& path);

}  // namespace quadrille
