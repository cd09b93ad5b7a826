#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace quadrille {

/// Highest version of the format that this program reads, and the one it writes.
inline constexpr std::uint32_t kDocumentVersion = 1;

/// FlatBuffers addresses no more than this.
inline constexpr std::uint64_t kLargestDocument = (std::uint64_t{1} << 31) - 1;

/// A header of 20 bytes (8 of signature, the version as uint32 and the unpacked size as uint64,
/// both little-endian) and one zstd frame with a checksum. The same content gives the same bytes.
std::vector<std::byte> pack_document(std::span<const std::uint8_t> content);

/// The content. Throws Error{unsupported_format} for a foreign signature or a newer version,
/// Error{limit_exceeded} for a size above kLargestDocument, Error{io_failure} for damage. Memory
/// grows with what really unpacks, not with what the header claims.
std::vector<std::uint8_t> unpack_document(std::span<const std::byte> bytes,
                                          const std::string& name);

/// Throws Error{io_failure}.
[[noreturn]] void report_damaged_document(const std::string& name, const std::string& why);
/// Throws Error{unsupported_format}.
[[noreturn]] void report_newer_document(const std::string& name);

}  // namespace quadrille
