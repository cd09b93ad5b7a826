#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quadrille/vector_image.h"

namespace quadrille {

/// The native document `.quad`: a FlatBuffers table compressed by zstd; docs/quad-format.md
/// describes it. Loading verifies everything before use: sizes and offsets, index ranges,
/// adjacency, wedges against tears, finite numbers. Reading a quantised document takes at most
/// 16 KiB of memory for each byte of the file, plus 4 MiB; reading a lossless one at most 8 times
/// what it unpacks to, which is below 2 GiB and 32 KiB for each byte of the file.

enum class DocumentEncoding {
  /// Integers, about 1/15 of the size. Vertices and quads are renumbered once; loading and saving
  /// again changes nothing any more.
  quantized,
  /// Every number bit for bit, in its place.
  lossless,
};

struct DocumentOptions {
  DocumentEncoding encoding = DocumentEncoding::quantized;
  /// Quantised only. Positions are rounded to multiples of 2^-position_bits pixels; vertices on the
  /// sides of the picture stay there exactly. -8 to 16; chosen for each layer by `error` if absent,
  /// and finer where patches would fold.
  std::optional<int> position_bits = {};
  /// Quantised only. Step of the colours in units of 1/255; derivatives are rounded so that they
  /// weigh as much in the rendered picture, and small patches more coarsely than large ones. 2^-8
  /// to 64; chosen for each layer by `error` if absent.
  std::optional<double> color_step = {};
  /// Quantised only. Mean absolute error of a layer drawn at scale 1, in units of 1/255, that
  /// rounding may cause, as far as the steps can be chosen. 2^-8 to 64.
  double error = 0.295;
};

/// DocumentOptions::error for an image that misses its source by `mae` (as of compare()): rounding
/// may cost about as much again, between 1/8 of a step and the default.
double document_error(double mae);

/// The same image and options give the same bytes. A layer that the quantised encoding cannot hold
/// (numbers out of proportion, a vertex of 255 quads) is stored lossless. Throws
/// Error{limit_exceeded} for an image that takes more than 2 GiB before compression, about 10
/// million patches, and Error{invalid_argument} for options outside their ranges.
std::vector<std::byte> to_document(const VectorImage& image, const DocumentOptions& options = {});
/// The image; of a lossless document, bit for bit. Throws Error{unsupported_format} for a foreign
/// file or a newer format version, Error{io_failure} for a damaged one, and Error{limit_exceeded}
/// for one that claims to unpack to more than 2 GiB. `name` is used in messages.
VectorImage from_document(std::span<const std::byte> bytes, const std::string& name = "document");

/// Written to a temporary beside the target and renamed. Throws Error{io_failure}.
void save_document(const VectorImage& image, const std::filesystem::path& path,
                   const DocumentOptions& options = {});
VectorImage load_document(const std::filesystem::path& path);

/// How a document holds its image.
struct DocumentStorage {
  int version = 0;               ///< of the format
  std::uint64_t file_bytes = 0;  ///< as stored
  struct LayerStorage {
    DocumentEncoding encoding = DocumentEncoding::lossless;
    int position_bits = 0;    ///< of a quantised layer, as in DocumentOptions
    double color_step = 0;    ///< of a quantised layer, as in DocumentOptions
    std::uint64_t bytes = 0;  ///< of the layer's arrays before compression by zstd
  };
  std::vector<LayerStorage> layers;
};

struct StoredImage {
  VectorImage image;
  DocumentStorage storage;
};

/// load_document() and what it has read. Throws as load_document() does.
StoredImage load_document_and_storage(const std::filesystem::path& path);

}  // namespace quadrille
