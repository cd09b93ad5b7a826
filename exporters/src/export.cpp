#include "quadrille/export.h"

#include <algorithm>
#include <memory>

#include "ending.h"
#include "quadrille/error.h"
#include "quadrille/left_out_formats.h"
#include "quadrille/picture_layers.h"

namespace quadrille {
namespace {

using Writer = void (*)(const VectorImage&, const std::filesystem::path&, const ExportOptions&,
                        const RunContext&);

struct Format {
  const char* ending;
  Writer write;
};

void raster(const VectorImage& image, const std::filesystem::path& path,
            const ExportOptions& options, const RunContext& context) {
  write_raster_file(image, path, options.raster, context);
}

void svg(const VectorImage& image, const std::filesystem::path& path, const ExportOptions& options,
         const RunContext& context) {
  write_svg(image, path, options.svg, context);
}

#ifdef QUADRILLE_HAS_PDF
void postscript(const VectorImage& image, const std::filesystem::path& path,
                const ExportOptions& options, const RunContext& context) {
  write_postscript(image, path, options.pdf, context);
}
#endif

#ifdef QUADRILLE_HAS_GLTF
void gltf(const VectorImage& image, const std::filesystem::path& path, const ExportOptions& options,
          const RunContext& context) {
  write_gltf(image, path, options.gltf, context);
}
#endif

#ifdef QUADRILLE_HAS_VTK
void vtm(const VectorImage& image, const std::filesystem::path& path, const ExportOptions&,
         const RunContext& context) {
  // The layers of a group share the image; here it outlives them.
  const std::shared_ptr<const VectorImage> shared(std::shared_ptr<void>(), &image);
  write_vtm({image.width, image.height, {picture_group(shared, nullptr, context)}}, path, context);
}
#endif

const Format kFormats[] = {
    {".quad",
     [](const VectorImage& image, const std::filesystem::path& path, const ExportOptions& options,
        const RunContext&) { save_document(image, path, options.document); }},
    {".png", raster},
    {".jpg", raster},
    {".jpeg", raster},
    {".webp", raster},
    {".tif", raster},
    {".tiff", raster},
    {".dzi", raster},
    {".svg", svg},
    {".svgz", svg},
#ifdef QUADRILLE_HAS_PDF
    {".pdf",
     [](const VectorImage& image, const std::filesystem::path& path, const ExportOptions& options,
        const RunContext& context) { write_pdf(image, path, options.pdf, context); }},
    {".ps", postscript},
    {".eps", postscript},
#endif
#ifdef QUADRILLE_HAS_GLTF
    {".glb", gltf},
    {".gltf", gltf},
#endif
#ifdef QUADRILLE_HAS_VTK
    {".vtu",
     [](const VectorImage& image, const std::filesystem::path& path, const ExportOptions& options,
        const RunContext& context) { write_vtu(image, path, options.vtk, context); }},
    {".vtp",
     [](const VectorImage& image, const std::filesystem::path& path, const ExportOptions& options,
        const RunContext& context) { write_vtp(image, path, options.vtk, context); }},
    {".vtm", vtm},
#endif
};

/// Endings of formats that a build may leave out, and what they need.
constexpr struct {
  const char *ending, *needs;
} kOptional[] = {{".pdf", "PDF"},   {".ps", "PDF"},  {".eps", "PDF"}, {".glb", "glTF"},
                 {".gltf", "glTF"}, {".vtu", "VTK"}, {".vtp", "VTK"}, {".vtm", "VTK"}};

[[noreturn]] void refuse_ending(const std::filesystem::path& path, const std::string& purpose,
                                const std::vector<std::string>& endings) {
  const std::string ending = lower_case_ending(path);
  std::string known;
  for (const std::string& each : endings) known += (known.empty() ? "" : ", ") + each;
  throw Error(ErrorCode::unsupported_format, "cannot " + purpose + " '" + path.string() + "': " +
                                                 why_unknown(ending) + "; use one of " + known);
}

}  // namespace

std::string why_unknown(const std::string& ending) {
  if (ending.empty()) return "its name has no ending";
  const std::vector<std::string> known = export_endings();
  if (std::ranges::find(known, ending) == known.end()) {
    for (const auto& format : kOptional) {
      if (ending != format.ending) continue;
      return "this program was built without " + std::string(format.needs) + ", which '" + ending +
             "' needs";
    }
  }
  return "the ending '" + ending + "' is not known here";
}

std::vector<std::string> export_endings() {
  std::vector<std::string> endings;
  for (const Format& format : kFormats) endings.push_back(format.ending);
  return endings;
}

void export_image(const VectorImage& image, const std::filesystem::path& path,
                  const ExportOptions& options, const RunContext& context) {
  const std::string ending = lower_case_ending(path);
  for (const Format& format : kFormats) {
    if (ending == format.ending) return format.write(image, path, options, context);
  }
  refuse_ending(path, "write", export_endings());
}

std::vector<std::string> import_endings() {
#ifdef QUADRILLE_HAS_VTK
  return {".quad", ".vtu", ".vtm"};
#else
  return {".quad"};
#endif
}

VectorImage import_image(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".quad") return load_document(path);
#ifdef QUADRILLE_HAS_VTK
  if (ending == ".vtu") return read_vtu(path);
  if (ending == ".vtm") return read_vtm(path);
#endif
  if (std::error_code ignored; std::filesystem::is_directory(path, ignored)) {
    throw Error(ErrorCode::io_failure, "cannot read patches from '" + path.string() +
                                           "': it is a folder; name a file in it");
  }
  refuse_ending(path, "read patches from", import_endings());
}

std::optional<Raster> import_source([[maybe_unused]] const std::filesystem::path& path) {
#ifdef QUADRILLE_HAS_VTK
  if (lower_case_ending(path) == ".vtm") return read_vtm_source(path);
#endif
  return std::nullopt;
}

void export_scene([[maybe_unused]] const Scene& scene, const std::filesystem::path& path,
                  [[maybe_unused]] const RunContext& context) {
#ifdef QUADRILLE_HAS_VTK
  if (lower_case_ending(path) == ".vtm") return write_vtm(scene, path, context);
#endif
  throw Error(ErrorCode::unsupported_format,
              "cannot write '" + path.string() +
                  "': scenes are written as .vtm, in builds with VTK; use that ending");
}

}  // namespace quadrille
