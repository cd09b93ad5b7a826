#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/document.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"
#include "quadrille/scene_layer.h"
#include "quadrille/vector_image.h"

namespace quadrille {

struct RasterFileOptions {
  double scale = 1;  ///< output pixels per source pixel
  int width = 0;     ///< when not 0, decides the size instead of scale
  int bits = 8;      ///< 8, or 16 for PNG and TIFF
  int quality = 90;  ///< JPEG, WebP and opaque deep-zoom tiles, 1 to 100
  /// Behind transparency where the format has none (JPEG).
  std::array<float, 3> background = {1, 1, 1};
};

/// How closely an SVG file shows the picture. The first three have a tolerance t: colours are
/// approximated more finely wherever that lowers the squared error (8-bit steps, summed over square
/// pixels, mean of the channels) by t^2 or more for a byte of the compressed file (a gradient
/// counts 9 bytes more than it takes, a stop 2, for the time of opening them). In calm layers,
/// where bands of gradients would show, t is down to half of that, in busy ones up to a twelfth
/// more.
enum class SvgLevel {
  compact,   ///< t = 3.5
  balanced,  ///< t = 1.25
  faithful,  ///< t = 0.42, and coordinates to 1/8 of a pixel instead of 1/2 (ten times finer along
             ///< tears and the outline, and at every level where the picture is steep)
  hybrid,    ///< one pixel image per side of the tears behind exact outlines: not independent of
             ///< the resolution inside
  inkscape,  ///< mesh gradients that Inkscape draws and edits; others show flat colours
};

struct SvgOptions {
  SvgLevel level = SvgLevel::balanced;
  /// Most bytes of the file as written, 0 for any: where the level takes more, a larger tolerance,
  /// up to 128, is searched that fits. The levels hybrid and inkscape
  /// allow none.
  std::uint64_t size_limit = 0;
  std::string title = "Quadrille picture";
};

/// For PDF and PostScript.
struct PdfOptions {
  /// Source pixels per inch, 1 to 10000; decides the page size. Acrobat shows pages of up to 14,400
  /// points, which are 19,200 pixels at 96.
  double dpi = 96;
  /// Colour error of a patch in 8-bit steps, at most half of it in the root mean square and at most
  /// twice of it anywhere, but for details below a pixel and up to 3/8 of a step by which colours
  /// are rounded up, as viewers cut off what is left of them; at least 0.5.
  double tolerance = 1.5;
  std::string title = "Quadrille picture";
};

enum class GltfColors {
  texture,  ///< textures that the rasterizer draws
  vertex,   ///< COLOR_0, linear: the triangles get as fine as the colours need
};

enum class GltfTextureFormat {
  png,
  webp,  ///< asks readers for EXT_texture_webp
  jpeg,  ///< PNG for textures with transparency
};

enum class GltfCompression {
  none,
  quantize,  ///< 16-bit vertices (KHR_mesh_quantization): off by at most 1/131070 of the box's
             ///< longest side
  meshopt,   ///< those, compressed (EXT_meshopt_compression)
};

struct GltfOptions {
  GltfColors colors = GltfColors::texture;
  /// Size of the textures in texels per source pixel, > 0; reduced where a side would exceed 8192.
  double texels_per_pixel = 2;
  GltfTextureFormat texture_format = GltfTextureFormat::png;
  int texture_quality = 90;  ///< WebP and JPEG, 1 to 100
  bool lit = false;          ///< a rough dielectric (PBR) with normals instead of an unlit one
  /// Height of white above black in pixels, -1e6 to 1e6: z is the luma of Rec. 709 of the
  /// sRGB-encoded premultiplied colours times this.
  double relief = 0;
  GltfCompression compression = GltfCompression::none;
};

struct VtkOptions {
  /// Quads per side of a patch in the tessellated surface of .vtp, 1 to 64.
  int divisions = 4;
  /// Fitting error per patch, layer after layer, for .vtu; empty when it is not known. See
  /// patch_errors().
  std::vector<float> patch_errors;
};

struct ExportOptions {
  RasterFileOptions raster;
  SvgOptions svg;
  PdfOptions pdf;
  GltfOptions gltf;
  VtkOptions vtk;
  DocumentOptions document;
};

/// One writer per format. Each writes to a temporary beside the target and renames it; the same
/// bytes for any thread count. They throw Error{io_failure} when the file cannot be written.
void write_raster_file(const VectorImage& image, const std::filesystem::path& path,
                       const RasterFileOptions& options = {}, const RunContext& context = {});
/// Compressed by gzip when the path ends in .svgz. Throws Error{limit_exceeded} when not even the
/// coarsest approximation keeps the size limit.
void write_svg(const VectorImage& image, const std::filesystem::path& path,
               const SvgOptions& options = {}, const RunContext& context = {});
/// One page of native Coons patch shadings (type 6): geometry exact to a sixteenth of a pixel,
/// colours bilinear in the cells of each patch. Tears, outlines and alpha are soft masks,
/// anti-aliased at any scale. Throws Error{invalid_argument} for options out of range, as
/// write_postscript() does.
void write_pdf(const VectorImage& image, const std::filesystem::path& path,
               const PdfOptions& options = {}, const RunContext& context = {});
/// PostScript of language level 3, encapsulated where the path ends in .eps: the shadings of
/// write_pdf(), their edges cut off without anti-aliasing. It knows no transparency: colours are
/// put over white.
void write_postscript(const VectorImage& image, const std::filesystem::path& path,
                      const PdfOptions& options = {}, const RunContext& context = {});
/// A binary .glb, or by the path's ending a .gltf beside NAME.bin and NAME-texture-K.png (.webp,
/// .jpg). Per layer a mesh of quads and few triangles (FB_ngon_encoding) without T-junctions,
/// within 0.05 pixels of the outline and of tears, along which vertices and textures are split: so
/// tears stay sharp at any scale. 1 unit = 1 pixel, x to the right, y up, the picture's bottom left
/// corner at the origin, its front towards +z, materials double-sided; layer k lies at z = k (1 +
/// |relief|). Transparent patches are left out. The mesh's extras.quadrille_document holds the
/// layer's patches: a quantised document in base64. Where nothing can be seen the scene is empty.
/// Throws Error{invalid_argument} for patches that are not finite or 1e7 pixels away, or options
/// out of range, and Error{limit_exceeded} above 2^26 quads in a layer.
void write_gltf(const VectorImage& image, const std::filesystem::path& path,
                const GltfOptions& options = {}, const RunContext& context = {});
/// One Bezier quadrilateral (VTK cell type 77) per patch, placed as in write_gltf(). Point arrays:
/// "color" (float RGB) or, with transparency, "color_premultiplied" (float RGBA) are the exact
/// control values; "rgba" (bytes, straight) is what plain viewers show, approximate where control
/// values leave 0..1. Cell arrays: "patch", "layer", "region", "scaled_jacobian", "valence" (four)
/// and, when it is known, "fitting_error"; and those of read_vtu(). The meaning of each array is
/// its information key vtkDataArray::UNITS_LABEL. Throws Error{invalid_argument} for a wrong number
/// of fitting errors.
void write_vtu(const VectorImage& image, const std::filesystem::path& path,
               const VtkOptions& options = {}, const RunContext& context = {});
/// surface_layer() as poly data, placed as in write_gltf().
void write_vtp(const VectorImage& image, const std::filesystem::path& path,
               const VtkOptions& options = {}, const RunContext& context = {});
/// A multi-block data set with a block per group and, in it, one per layer, named like them. The
/// pieces lie beside it in a folder that is named like the file with "_vtm" in place of the ending;
/// the file itself is written last. y is up, the picture's bottom left corner at the origin.
void write_vtm(const Scene& scene, const std::filesystem::path& path,
               const RunContext& context = {});

/// Reads a file that write_vtu() wrote, perhaps stored again by another program that kept all
/// arrays, as raw appended data: the same image bit for bit. Field arrays "picture_size",
/// "layer_names", "metadata" and, per layer L, "layerL_transform", "_opaque", "_vertices",
/// "_edge_flags", "_edge_tangents" and
/// "_wedges"; cell arrays "layer", "corner_vertices" and "corner_wedges". Everything is verified as
/// in a .quad document, and the control points must be those of the patches. Throws
/// Error{unsupported_format} for a foreign file, Error{io_failure} for a missing or damaged one.
VectorImage read_vtu(const std::filesystem::path& path);

/// read_vtu() of the piece "patches" in the block "picture" of a file that write_vtm() wrote of a
/// picture_group(). Throws Error{unsupported_format} for a foreign file or one that names a piece
/// outside of its own folder, Error{io_failure} when the file or the piece is missing or damaged,
/// Error{limit_exceeded} for a file of more than 64 MiB (without its pieces).
VectorImage read_vtm(const std::filesystem::path& path);

/// The picture that these patches were made of, in 8 bits a channel, where the file keeps it as the
/// piece "picture" of that block. Throws as read_vtm(), and Error{limit_exceeded} for more than 300
/// million pixels.
std::optional<Raster> read_vtm_source(const std::filesystem::path& path);

/// File endings, with the dot and in lower case, of files with patches that import_image() reads in
/// this build: .quad, .vtu and .vtm.
std::vector<std::string> import_endings();

/// load_document(), read_vtu() or read_vtm() by the ending of the path. Throws
/// Error{unsupported_format} for any other ending, and as these do.
VectorImage import_image(const std::filesystem::path& path);

/// read_vtm_source() of a .vtm; no other format keeps the picture.
std::optional<Raster> import_source(const std::filesystem::path& path);

/// File endings, with the dot and in lower case, that export_image() writes in this build.
std::vector<std::string> export_endings();

/// Chooses the writer by the ending of the path: .quad, .png, .jpg, .jpeg, .webp, .tif, .tiff,
/// .dzi, .svg, .svgz, .pdf, .ps, .eps, .glb, .gltf, .vtu, .vtp, .vtm (picture_group() without a
/// source). Throws Error{unsupported_format} for any other, naming those it can write.
void export_image(const VectorImage& image, const std::filesystem::path& path,
                  const ExportOptions& options = {}, const RunContext& context = {});

/// write_vtm(). Throws Error{unsupported_format} for another ending, and for .vtm in a build
/// without VTK.
void export_scene(const Scene& scene, const std::filesystem::path& path,
                  const RunContext& context = {});

}  // namespace quadrille
