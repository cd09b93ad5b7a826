#pragma once

#include <filesystem>
#include <vector>

#include "gltf_buffers.h"
#include "texture_file.h"

namespace quadrille {

/// Writes the model with its binary data and pictures: as one binary file (.glb), or as a .gltf
/// beside NAME.bin and NAME-texture-K.png (or .webp, .jpg). All files are finished beside their
/// targets before the first is renamed, the .gltf last; when writing fails, none stays that was not
/// there before. Throws Error{io_failure}.
void write_gltf_files(tinygltf::Model& model, GltfBuffers& buffers,
                      const std::vector<EncodedTexture>& textures,
                      const std::filesystem::path& path);

}  // namespace quadrille
