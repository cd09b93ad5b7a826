#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "observer.h"
#include "picture_scene.h"
#include "quadrille/export.h"

namespace quadrille::cli {

/// Endings of the formats made of pixels.
inline const std::vector<std::string> kRasterEndings = {".png", ".jpg",  ".jpeg", ".webp",
                                                        ".tif", ".tiff", ".dzi"};

/// The path's ending in lower case, with the dot.
std::string ending_of(const std::filesystem::path& path);

/// Refuses, before anything is computed, outputs whose ending is not among `endings`, whose folder
/// is missing or closed to us, that are folders themselves, that are named twice, or that would
/// overwrite one of the inputs, of which empty ones are none. Throws Error{unsupported_format},
/// {io_failure} or {invalid_argument}.
void check_outputs(const std::vector<std::filesystem::path>& outputs,
                   const std::vector<std::filesystem::path>& inputs,
                   const std::vector<std::string>& endings);

/// Refuses a scale or width that makes a picture too large for `output`; for formats without pixels
/// it does nothing. Throws Error{limit_exceeded}.
void check_size(double image_width, double image_height, const RasterFileOptions& options,
                const std::filesystem::path& output);

/// An image and what is known of how it was made.
struct OutputImage {
  const VectorImage& image;
  Origin origin = {};
};

/// Writes the image to every output in turn, each as a stage of its own. Titles come from the
/// image's metadata, so that a document exports to the same bytes as the run that made it; when the
/// origin is known, .vtu and .vtm hold more, and .quad is rounded by document_error().
void write_outputs(const OutputImage& output, const std::vector<std::filesystem::path>& paths,
                   ExportOptions options, Observer& observer);

/// Tells the watcher about a finished file and its size.
void tell_written(const std::filesystem::path& path, Observer& observer);

}  // namespace quadrille::cli
