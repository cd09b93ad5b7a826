#include "quadrille/export.h"

#include "ending.h"
#include "quadrille/error.h"

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
#endif
};

}  // namespace

std::vector<std::string> export_endings() {
  std::vector<std::string> endings;
  for (const Format& format : kFormats) endings.push_back(format.ending);
  return endings;
}

void export_image(const VectorImage& image, const std::filesystem::path& path,
                  const ExportOptions& options, const RunContext& context) {
  const std::string ending = lower_case_ending(path);
  std::string known;
  for (const Format& format : kFormats) {
    if (ending == format.ending) return format.write(image, path, options, context);
    known += known.empty() ? "" : ", ";
    known += format.ending;
  }
  throw Error(ErrorCode::unsupported_format,
              "cannot write '" + path.string() + "': " +
                  (ending.empty() ? "it has no file ending" : "unknown file ending " + ending) +
                  "; use one of " + known);
}

}  // namespace quadrille
