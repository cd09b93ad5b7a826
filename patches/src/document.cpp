#include "quadrille/document.h"

#include <cmath>
#include <fstream>
#include <system_error>

#include "document_container.h"
#include "document_patches.h"
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

Offset<fbs::Layer> store_layer(FlatBufferBuilder& builder, const Layer& layer) {
  const auto name = builder.CreateString(layer.name);
  const auto patches = store_patches(builder, layer.patches);
  const auto& m = layer.transform.matrix();
  const fbs::Affine transform(m(0, 0), m(0, 1), m(1, 0), m(1, 1), m(0, 2), m(1, 2));
  return fbs::CreateLayer(builder, name, &transform, layer.patches.opaque,
                          fbs::Patches::LosslessPatches, patches.Union());
}

Layer restore_layer(const fbs::Layer& stored, const std::string& name) {
  const fbs::LosslessPatches* patches = stored.patches_as_LosslessPatches();
  if (!patches) report_newer_document(name);
  Layer layer;
  layer.name = stored.name()->str();
  const fbs::Affine& t = *stored.transform();
  layer.transform.matrix() << t.xx(), t.xy(), t.x(), t.yx(), t.yy(), t.y(), 0, 0, 1;
  if (!layer.transform.matrix().allFinite()) {
    report_damaged_document(name, "a transform is not finite");
  }
  layer.patches = restore_patches(*patches, name);
  layer.patches.opaque = stored.opaque();
  return layer;
}

const fbs::Document& verified(const std::vector<std::uint8_t>& content, const std::string& name) {
  constexpr flatbuffers::uoffset_t kDepth = 8, kTables = 1'000'000;
  flatbuffers::Verifier verifier(content.data(), content.size(), kDepth, kTables);
  if (!fbs::VerifyDocumentBuffer(verifier)) {
    report_damaged_document(name, "its structure is invalid");
  }
  return *fbs::GetDocument(content.data());
}

}  // namespace

std::vector<std::byte> to_document(const VectorImage& image) {
  check_storable(image);
  FlatBufferBuilder builder;
  std::vector<Offset<fbs::Layer>> layers;
  for (const Layer& layer : image.layers) layers.push_back(store_layer(builder, layer));
  std::vector<Offset<fbs::MetadataEntry>> metadata;
  for (const auto& [key, value] : image.metadata) {
    const auto stored_key = builder.CreateString(key);
    metadata.push_back(fbs::CreateMetadataEntry(builder, stored_key, builder.CreateString(value)));
  }
  const auto stored_layers = builder.CreateVector(layers);
  const auto stored_metadata = builder.CreateVector(metadata);
  fbs::FinishDocumentBuffer(builder, fbs::CreateDocument(builder, image.width, image.height,
                                                         stored_layers, stored_metadata));
  return pack_document({builder.GetBufferPointer(), builder.GetSize()});
}

VectorImage from_document(std::span<const std::byte> bytes, const std::string& name) {
  const std::vector<std::uint8_t> content = unpack_document(bytes, name);
  const fbs::Document& stored = verified(content, name);
  VectorImage image;
  image.width = stored.width();
  image.height = stored.height();
  const auto is_size = [](double side) { return std::isfinite(side) && side > 0; };
  if (!is_size(image.width) || !is_size(image.height)) {
    report_damaged_document(name, "its size is not positive");
  }
  for (const fbs::Layer* layer : *stored.layers()) {
    image.layers.push_back(restore_layer(*layer, name));
  }
  for (const fbs::MetadataEntry* entry : *stored.metadata()) {
    if (!image.metadata.emplace(entry->key()->str(), entry->value()->str()).second) {
      report_damaged_document(name, "a metadata key is repeated");
    }
  }
  return image;
}

void save_document(const VectorImage& image, const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = to_document(image);
  write_stream_atomically(path, [&](std::ostream& file) {
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  });
}

VectorImage load_document(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorCode::io_failure, "cannot read '" + path.string() + "': " + why);
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse("it is a folder; name a document in it");
  const auto size = std::filesystem::file_size(path, error);
  if (error) refuse(error.message() + "; check the path");
  if (size > kLargestDocument) refuse("it is larger than 2 GiB; use an intact copy");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("it cannot be opened; check its permissions");
  std::vector<std::byte> bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (file.gcount() != static_cast<std::streamsize>(size)) refuse("it ends too early; try again");
  return from_document(bytes, path.string());
}

}  // namespace quadrille
