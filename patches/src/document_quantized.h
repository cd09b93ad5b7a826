#pragma once

#include <string>

#include "document_generated.h"
#include "document_quantizer.h"
#include "quadrille/patch_mesh.h"

namespace quadrille {

/// False for numbers that are not finite or out of all proportion, for vertices with 255 quads or
/// more, and for wedges that do not follow the tears; the lossless encoding holds all of them.
bool can_store_quantized(const PatchMesh& patches, double width, double height,
                         const StepChoice& choice);

flatbuffers::Offset<fbs::QuantizedPatches> store_quantized(flatbuffers::FlatBufferBuilder& builder,
                                                           const PatchMesh& patches, double width,
                                                           double height, const StepChoice& choice);

/// Throws Error{io_failure}, naming the document, for codes that are not those of a patch mesh.
/// The caller has checked the number of quads against the size of the file.
PatchMesh restore_quantized(const fbs::QuantizedPatches& stored, double width, double height,
                            bool opaque, const std::string& name);

}  // namespace quadrille
