#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "quadrille/vector_image.h"

namespace quadrille {

/// The native document `.quad`: a FlatBuffers table compressed by zstd, lossless. Loading verifies
/// everything before use: sizes and offsets, index ranges, adjacency, wedges against tears, finite
/// numbers.

/// The same image gives the same bytes. Throws Error{limit_exceeded} for an image that takes more
/// than 2 GiB before compression, about 10 million patches.
std::vector<std::byte> to_document(const VectorImage& image);
/// The image, bit for bit. Throws Error{unsupported_format} for a foreign file or a newer format
/// version, Error{io_failure} for a damaged one, and Error{limit_exceeded} for one that claims to
/// unpack to more than 2 GiB. `name` is used in messages.
VectorImage from_document(std::span<const std::byte> bytes, const std::string& name = "document");

/// Written to a temporary beside the target and renamed. Throws Error{io_failure}.
void save_document(const VectorImage& image, const std::filesystem::path& path);
VectorImage load_document(const std::filesystem::path& path);

}  // namespace quadrille
