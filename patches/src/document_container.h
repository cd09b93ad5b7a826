#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace quadrille {

/// Versions of the format. A document has the lowest one whose readers understand it.
inline constexpr std::uint32_t kLosslessVersion = 1;
inline constexpr std::uint32_t kQuantizedVersion = 2;
/// The highest one that this program reads.
inline constexpr std::uint32_t kDocumentVersion = kQuantizedVersion;

/// FlatBuffers addresses no more than this.
inline constexpr std::uint64_t kLargestDocument = (std::uint64_t{1} << 31) - 1;

/// From version 2 on a file is at least as large as its unpacked content divided by this, and as
/// its quads divided by kMostQuadsPerByte, so that no small file claims much memory.
inline constexpr std::uint64_t kMostContentPerByte = 64;
inline constexpr std::uint64_t kMostQuadsPerByte = 4;

struct UnpackedDocument {
  std::uint32_t version = 0;
  std::vector<std::uint8_t> content;
};

/// A header of 20 bytes (8 of signature, the version as uint32 and the unpacked size as uint64,
/// both little-endian), one zstd frame with a checksum and, from version 2 on, zeros up to the
/// least size for that content and `quads`. The same content gives the same bytes.
std::vector<std::byte> pack_document(std::span<const std::uint8_t> content, std::uint32_t version,
                                     std::uint64_t quads);

/// The content. Throws Error{unsupported_format} for a foreign signature or a newer version,
/// Error{limit_exceeded} for a size above kLargestDocument, Error{io_failure} for damage. Memory
/// grows with what really unpacks, not with what the header claims.
UnpackedDocument unpack_document(std::span<const std::byte> bytes, const std::string& name);

/// Throws Error{io_failure}.
[[noreturn]] void report_damaged_document(const std::string& name, const std::string& why);
/// Throws Error{unsupported_format}.
[[noreturn]] void report_newer_document(const std::string& name);

}  // namespace quadrille
