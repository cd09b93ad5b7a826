#pragma once

#include <string>

#include "document_generated.h"
#include "quadrille/patch_mesh.h"

namespace quadrille {

flatbuffers::Offset<fbs::LosslessPatches> store_patches(flatbuffers::FlatBufferBuilder& builder,
                                                        const PatchMesh& patches);

/// All but PatchMesh::opaque. Throws Error{io_failure}, naming the document, for anything that is
/// not a patch mesh: sizes that do not fit together, indices out of range, wrong adjacency, wedges
/// that contradict the tears, numbers that are not finite.
PatchMesh restore_patches(const fbs::LosslessPatches& stored, const std::string& name);

/// Bytes that the patches take in a document before compression.
std::size_t stored_size(const PatchMesh& patches);

}  // namespace quadrille
