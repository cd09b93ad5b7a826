#pragma once

#include <filesystem>
#include <memory>

#include "chosen_options.h"
#include "common_options.h"
#include "observer.h"
#include "quadrille/error.h"
#include "quadrille/error_bound.h"
#include "quadrille/raster.h"
#include "quadrille/vector_image.h"

namespace quadrille::cli {

/// True for files of patches (.quad, .vtu, .vtm), also of those that this build cannot read; all
/// others are read as pictures.
bool is_document(const std::filesystem::path& path);

/// Throws UsageError when options of the mesh are given for a document, whose mesh is made already.
void check_mesh_options(const std::filesystem::path& path, const MeshOptions& mesh);

/// A picture's pixels. Throws Error{unsupported_format} for a document, whose patches would be
/// drawn and fitted again.
Raster read_picture(const std::filesystem::path& path, Observer& observer);

/// A picture's pixels; a document is drawn at scale 1.
Raster read_raster(const std::filesystem::path& path, Observer& observer);

/// A document's content; a picture is vectorized with the options.
VectorImage read_vector_image(const std::filesystem::path& path, const MeshOptions& mesh,
                              Observer& observer);

/// The picture that the patches of a document were made of: the one named `source` unless that is
/// empty, else the one that the document keeps, else null. Throws Error{invalid_argument} when its
/// size is another than the image's.
std::shared_ptr<const Raster> read_source(const std::filesystem::path& document,
                                          const std::filesystem::path& source,
                                          const VectorImage& image, Observer& observer);

/// Vectorizes a picture and notes in the metadata what the documents should remember of it.
Vectorization vectorize_picture(const Raster& picture, const std::filesystem::path& source,
                                const VectorizeOptions& options, Observer& observer);

struct StagedVectorization {
  Vectorization result;
  Quadrangulation stages;
};
/// The same, and what the patches were made from.
StagedVectorization vectorize_in_stages(const Raster& picture, const std::filesystem::path& source,
                                        const VectorizeOptions& options, Observer& observer);

/// The same for vectorize_to_error().
BoundedVectorization vectorize_picture_to_error(const Raster& picture,
                                                const std::filesystem::path& source,
                                                const ErrorBound& bound,
                                                const VectorizeOptions& options,
                                                Observer& observer);

/// The file's name without its folder as valid, printable UTF-8.
std::string printable_name(const std::filesystem::path& path);

/// Calls work(), which complains of the picture, and puts the file's name in front of the
/// complaint.
template <class Work>
auto with_name_of(const std::filesystem::path& source, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::degenerate_input) throw;
    throw Error(error.code(), "'" + source.string() + "': " + error.what());
  }
}

}  // namespace quadrille::cli
