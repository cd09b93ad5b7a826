#include "document_container.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <memory>

#include "quadrille/error.h"

namespace quadrille {
namespace {

// As in PNG: the first byte keeps it from being taken for text, and the line ends show whether a
// transfer in text mode has changed them.
constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'Q', 'U', 'A', 'D', '\r', '\n', 0x1a};
constexpr std::size_t kHeaderSize = kSignature.size() + 4 + 8;
// Higher levels save 1 % for 20 times the time: most bytes are mantissas.
constexpr int kCompressionLevel = 3;

void put(std::vector<std::byte>& out, std::uint64_t value, int bytes) {
  for (int b = 0; b < bytes; ++b) out.push_back(static_cast<std::byte>(value >> (8 * b)));
}

std::uint64_t get(std::span<const std::byte> in, int bytes) {
  std::uint64_t value = 0;
  for (int b = 0; b < bytes; ++b) value |= std::to_integer<std::uint64_t>(in[b]) << (8 * b);
  return value;
}

struct FreeCompressor {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};
struct FreeDecompressor {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

/// The content of the frame at the start of `bytes`, whose length is added to `used`.
std::vector<std::uint8_t> decompress(std::span<const std::byte> bytes, std::size_t size,
                                     const std::string& name, std::size_t& used) {
  constexpr std::size_t kFirstPart = 1 << 20;
  // What the compression level uses; zstd would allow a damaged frame to claim 128 MiB.
  constexpr int kLargestWindowLog = 21;
  const std::unique_ptr<ZSTD_DCtx, FreeDecompressor> context(ZSTD_createDCtx());
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, kLargestWindowLog);
  std::vector<std::uint8_t> content(std::min(size, kFirstPart));
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  std::size_t done = 0;
  for (;;) {
    ZSTD_outBuffer out{content.data(), content.size(), done};
    const std::size_t before = in.pos;
    const std::size_t left = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(left)) report_damaged_document(name, ZSTD_getErrorName(left));
    const bool moved = out.pos > done || in.pos > before;
    done = out.pos;
    if (left == 0) break;
    if (done == content.size() && content.size() < size) {
      content.resize(std::min(size, 2 * content.size()));
    } else if (!moved) {
      report_damaged_document(name, in.pos == in.size ? "it ends too early" : "it is too long");
    }
  }
  if (done != size) report_damaged_document(name, "its size is wrong");
  used += in.pos;
  return content;
}

std::uint64_t least_size(std::uint32_t version, std::uint64_t content, std::uint64_t quads) {
  if (version < kQuantizedVersion) return 0;
  return std::max((content + kMostContentPerByte - 1) / kMostContentPerByte,
                  (quads + kMostQuadsPerByte - 1) / kMostQuadsPerByte);
}

}  // namespace

void report_damaged_document(const std::string& name, const std::string& why) {
  throw Error(ErrorCode::io_failure,
              "the document '" + name + "' is damaged (" + why + "); use an intact copy");
}

void report_newer_document(const std::string& name) {
  throw Error(
      ErrorCode::unsupported_format,
      "the document '" + name + "' was written by a newer Quadrille; update this one to read it");
}

std::vector<std::byte> pack_document(std::span<const std::uint8_t> content, std::uint32_t version,
                                     std::uint64_t quads) {
  std::vector<std::byte> bytes;
  bytes.reserve(kHeaderSize);
  for (const std::uint8_t s : kSignature) bytes.push_back(static_cast<std::byte>(s));
  put(bytes, version, 4);
  put(bytes, content.size(), 8);
  bytes.resize(kHeaderSize + ZSTD_compressBound(content.size()));
  const std::unique_ptr<ZSTD_CCtx, FreeCompressor> context(ZSTD_createCCtx());
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kCompressionLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  const std::size_t size =
      ZSTD_compress2(context.get(), bytes.data() + kHeaderSize, bytes.size() - kHeaderSize,
                     content.data(), content.size());
  if (ZSTD_isError(size)) {
    throw Error(ErrorCode::numerical_failure, std::string("the document cannot be compressed (") +
                                                  ZSTD_getErrorName(size) +
                                                  "); free some memory and try again");
  }
  bytes.resize(kHeaderSize + size);
  bytes.resize(std::max(bytes.size(), least_size(version, content.size(), quads)));
  return bytes;
}

UnpackedDocument unpack_document(std::span<const std::byte> bytes, const std::string& name) {
  const std::size_t common = std::min(bytes.size(), kSignature.size());
  const bool ours = std::equal(bytes.begin(), bytes.begin() + common, kSignature.begin(),
                               [](std::byte a, std::uint8_t b) { return a == std::byte{b}; });
  if (!ours || bytes.empty()) {
    throw Error(ErrorCode::unsupported_format,
                "'" + name +
                    "' is not a Quadrille document; use a .quad file, or vectorize the "
                    "picture first");
  }
  if (bytes.size() < kHeaderSize) report_damaged_document(name, "it ends within its header");
  const auto version = static_cast<std::uint32_t>(get(bytes.subspan(kSignature.size()), 4));
  if (version > kDocumentVersion) report_newer_document(name);
  if (version == 0) report_damaged_document(name, "its version is 0");
  const std::uint64_t size = get(bytes.subspan(kSignature.size() + 4), 8);
  if (size > kLargestDocument) {
    throw Error(ErrorCode::limit_exceeded, "the document '" + name + "' would unpack to " +
                                               std::to_string(size) +
                                               " bytes, more than 2 GiB; use an intact copy");
  }
  if (bytes.size() < least_size(version, size, 0)) {
    report_damaged_document(name, "it is too small for its content");
  }
  std::size_t used = kHeaderSize;
  UnpackedDocument document{version, decompress(bytes.subspan(kHeaderSize), size, name, used)};
  const auto rest = bytes.subspan(used);
  const bool padded =
      version >= kQuantizedVersion &&
      std::all_of(rest.begin(), rest.end(), [](std::byte b) { return b == std::byte{0}; });
  if (!rest.empty() && !padded) report_damaged_document(name, "something follows its content");
  return document;
}

}  // namespace quadrille
