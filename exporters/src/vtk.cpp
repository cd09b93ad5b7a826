#include "quadrille/atomic_file.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "quadrille/picture_layers.h"
#include "vtk_data_file.h"
#include "vtk_patch_grid.h"
#include "vtk_scene_data.h"

namespace quadrille {
namespace {

void write_atomically_as(const char* stage, vtkDataObject* data, const std::filesystem::path& path,
                         const RunContext& context) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    write_data_file(data, temporary, path, stage, context);
  });
  context.progress(stage, 1);
}

}  // namespace

void write_vtu(const VectorImage& image, const std::filesystem::path& path,
               const VtkOptions& options, const RunContext& context) {
  write_atomically_as("vtu", patch_grid(image, options.patch_errors, context), path, context);
}

void write_vtp(const VectorImage& image, const std::filesystem::path& path,
               const VtkOptions& options, const RunContext& context) {
  const SceneLayer surface = surface_layer(image, options.divisions, context);
  write_atomically_as("vtp", scene_data(surface, image.height, context), path, context);
}

}  // namespace quadrille
