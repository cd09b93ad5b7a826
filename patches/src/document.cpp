#include "quadrille/document.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <system_error>

#include "document_container.h"
#include "document_patches.h"
#include "document_quantized.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

void check_storable(const VectorImage& image) {
  constexpr std::size_t kTableSize = 256;  // of a layer or a metadata entry; generous
  std::size_t size = 2 * kTableSize;
  for (const Layer& layer : image.layers) {
    size += kTableSize + layer.name.size() + stored_size(layer.patches);
  }
  for (const auto& [key, value] : image.metadata) size += kTableSize + key.size() + value.size();
  if (size > kLargestDocument) {
    throw Error(ErrorCode::limit_exceeded,
                "a picture with " + std::to_string(image.patch_count()) +
                    " patches does not fit into a document of 2 GiB; use fewer patches");
  }
}

StepChoice steps_of(const DocumentOptions& options) {
  if (options.position_bits && (*options.position_bits < -8 || *options.position_bits > 16)) {
    throw Error(ErrorCode::invalid_argument, "position_bits of a document must be from -8 to 16");
  }
  const auto is_step = [](double step) { return step >= 0x1p-8 && step <= 64; };
  if (options.color_step && !is_step(*options.color_step)) {
    throw Error(ErrorCode::invalid_argument, "color_step of a document must be from 2^-8 to 64");
  }
  if (!is_step(options.error)) {
    throw Error(ErrorCode::invalid_argument, "error of a document must be from 2^-8 to 64");
  }
  StepChoice choice{options.position_bits, {}, options.error / 255};
  if (options.color_step) choice.color = static_cast<float>(*options.color_step / 255);
  return choice;
}

/// Stores the layers of one image and keeps account of what the container must know.
class LayerWriter {
 public:
  LayerWriter(FlatBufferBuilder& builder, const VectorImage& image, const DocumentOptions& options)
      : builder_(builder),
        image_(image),
        lossless_(options.encoding == DocumentEncoding::lossless),
        steps_(steps_of(options)) {}

  Offset<fbs::Layer> store(const Layer& layer) {
    const auto name = builder_.CreateString(layer.name);
    const auto& m = layer.transform.matrix();
    const fbs::Affine transform(m(0, 0), m(0, 1), m(1, 0), m(1, 1), m(0, 2), m(1, 2));
    const PatchMesh& patches = layer.patches;
    const bool quantized =
        !lossless_ && can_store_quantized(patches, image_.width, image_.height, steps_);
    if (!quantized) {
      return fbs::CreateLayer(builder_, name, &transform, patches.opaque,
                              fbs::Patches::LosslessPatches,
                              store_patches(builder_, patches).Union());
    }
    version_ = kQuantizedVersion;
    quads_ += static_cast<std::uint64_t>(patches.patch_count());
    return fbs::CreateLayer(
        builder_, name, &transform, patches.opaque, fbs::Patches::QuantizedPatches,
        store_quantized(builder_, patches, image_.width, image_.height, steps_).Union());
  }
  std::uint32_t version() const { return version_; }
  std::uint64_t quantized_quads() const { return quads_; }

 private:
  FlatBufferBuilder& builder_;
  const VectorImage& image_;
  bool lossless_;
  StepChoice steps_;
  std::uint32_t version_ = kLosslessVersion;
  std::uint64_t quads_ = 0;
};

Layer restore_layer(const fbs::Layer& stored, const VectorImage& image, const std::string& name) {
  Layer layer;
  layer.name = stored.name()->str();
  const fbs::Affine& t = *stored.transform();
  layer.transform.matrix() << t.xx(), t.xy(), t.x(), t.yx(), t.yy(), t.y(), 0, 0, 1;
  if (!layer.transform.matrix().allFinite()) {
    report_damaged_document(name, "a transform is not finite");
  }
  if (const auto* lossless = stored.patches_as_LosslessPatches()) {
    layer.patches = restore_patches(*lossless, name);
  } else if (const auto* quantized = stored.patches_as_QuantizedPatches()) {
    layer.patches = restore_quantized(*quantized, image.width, image.height, stored.opaque(), name);
  } else {
    report_newer_document(name);
  }
  layer.patches.opaque = stored.opaque();
  return layer;
}

void check_quads(const fbs::Document& stored, std::size_t file_size, const std::string& name) {
  std::uint64_t quads = 0;
  for (const fbs::Layer* layer : *stored.layers()) {
    if (const auto* patches = layer->patches_as_QuantizedPatches()) quads += patches->quad_count();
  }
  if (quads > kMostQuadsPerByte * file_size) {
    report_damaged_document(name, "it is too small for its patches");
  }
}

const fbs::Document& verified(const std::vector<std::uint8_t>& content, const std::string& name) {
  constexpr flatbuffers::uoffset_t kDepth = 8, kTables = 1'000'000;
  flatbuffers::Verifier verifier(content.data(), content.size(), kDepth, kTables);
  if (!fbs::VerifyDocumentBuffer(verifier)) {
    report_damaged_document(name, "its structure is invalid");
  }
  return *fbs::GetDocument(content.data());
}

std::vector<std::byte> read_file(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorCode::io_failure, "cannot read '" + path.string() + "': " + why);
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse("it is a folder; name a document in it");
  const auto size = std::filesystem::file_size(path, error);
  if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path)) {
    refuse("it is not a regular file; name a document");
  }
  if (error) refuse(error.message() + "; check the path");
  if (size > kLargestDocument) refuse("it is larger than 2 GiB; use an intact copy");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("it cannot be opened; check its permissions");
  std::vector<std::byte> bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (file.gcount() != static_cast<std::streamsize>(size)) refuse("it ends too early; try again");
  return bytes;
}

DocumentStorage::LayerStorage storage_of(const fbs::Layer& layer, const std::string& name) {
  if (const auto* p = layer.patches_as_LosslessPatches()) {
    const std::uint64_t bytes = p->quads()->size() + p->vertices()->size() +
                                p->edge_flags()->size() + p->edge_tangents()->size() +
                                p->wedge_of_corner()->size() + p->wedges()->size();
    return {DocumentEncoding::lossless, 0, 0, bytes};
  }
  if (const auto* p = layer.patches_as_QuantizedPatches()) {
    const std::uint64_t bytes =
        p->connectivity()->size() + p->geometry()->size() + p->colors()->size();
    return {DocumentEncoding::quantized, p->position_exponent(), p->color_step() * 255.0, bytes};
  }
  report_newer_document(name);
}

/// FlatBuffers lets many offsets lead to one place; then a small document would claim any size.
void check_unshared(const fbs::Document& stored, std::size_t content, const std::string& name) {
  // Bytes that each takes at least beside its arrays and strings: offsets, lengths, a transform.
  constexpr std::uint64_t kLeastLayer = 96, kLeastMetadata = 20;
  std::uint64_t claimed = 0;
  for (const fbs::Layer* layer : *stored.layers()) {
    claimed += kLeastLayer + layer->name()->size() + storage_of(*layer, name).bytes;
  }
  for (const fbs::MetadataEntry* entry : *stored.metadata()) {
    claimed += kLeastMetadata + entry->key()->size() + entry->value()->size();
  }
  if (claimed > content) report_damaged_document(name, "its parts are larger than the whole");
}

StoredImage restore(const UnpackedDocument& document, std::size_t file_size,
                    const std::string& name) {
  const fbs::Document& stored = verified(document.content, name);
  StoredImage result;
  auto& [image, storage] = result;
  storage.version = static_cast<int>(document.version);
  storage.file_bytes = file_size;
  image.width = stored.width();
  image.height = stored.height();
  const auto is_size = [](double side) { return std::isfinite(side) && side > 0; };
  if (!is_size(image.width) || !is_size(image.height)) {
    report_damaged_document(name, "its size is not positive");
  }
  check_unshared(stored, document.content.size(), name);
  check_quads(stored, file_size, name);
  for (const fbs::Layer* layer : *stored.layers()) {
    image.layers.push_back(restore_layer(*layer, image, name));
    storage.layers.push_back(storage_of(*layer, name));
  }
  for (const fbs::MetadataEntry* entry : *stored.metadata()) {
    if (!image.metadata.emplace(entry->key()->str(), entry->value()->str()).second) {
      report_damaged_document(name, "a metadata key is repeated");
    }
  }
  return result;
}

}  // namespace

double document_error(double mae) {
  constexpr double kLeast = 0.125;
  return std::clamp(mae, kLeast, DocumentOptions{}.error);
}

std::vector<std::byte> to_document(const VectorImage& image, const DocumentOptions& options) {
  check_storable(image);
  FlatBufferBuilder builder;
  LayerWriter writer(builder, image, options);
  std::vector<Offset<fbs::Layer>> layers;
  for (const Layer& layer : image.layers) layers.push_back(writer.store(layer));
  std::vector<Offset<fbs::MetadataEntry>> metadata;
  for (const auto& [key, value] : image.metadata) {
    const auto stored_key = builder.CreateString(key);
    metadata.push_back(fbs::CreateMetadataEntry(builder, stored_key, builder.CreateString(value)));
  }
  const auto stored_layers = builder.CreateVector(layers);
  const auto stored_metadata = builder.CreateVector(metadata);
  fbs::FinishDocumentBuffer(builder, fbs::CreateDocument(builder, image.width, image.height,
                                                         stored_layers, stored_metadata));
  return pack_document({builder.GetBufferPointer(), builder.GetSize()}, writer.version(),
                       writer.quantized_quads());
}

VectorImage from_document(std::span<const std::byte> bytes, const std::string& name) {
  return restore(unpack_document(bytes, name), bytes.size(), name).image;
}

void save_document(const VectorImage& image, const std::filesystem::path& path,
                   const DocumentOptions& options) {
  const std::vector<std::byte> bytes = to_document(image, options);
  write_stream_atomically(path, [&](std::ostream& file) {
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  });
}

VectorImage load_document(const std::filesystem::path& path) {
  return from_document(read_file(path), path.string());
}

StoredImage load_document_and_storage(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  return restore(unpack_document(bytes, path.string()), bytes.size(), path.string());
}

}  // namespace quadrille
