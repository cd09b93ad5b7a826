#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <fstream>
#include <utility>
#include <vector>

#include "arena_size.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "svg_cell_writer.h"
#include "svg_cells.h"
#include "svg_layer.h"
#include "svg_outline.h"
#include "svg_text.h"
#include "svg_underlay.h"

namespace quadrille {
namespace {

/// How far a cell goes on under what is painted later, in pixels of the picture: at scale 1 and
/// above, a device pixel on a seam is then covered by the first cell alone.
constexpr double kBleed = 1;
/// Patches that are worked on together; bounds the memory.
constexpr int kChunk = 512;

class SvgWriter {
 public:
  SvgWriter(const VectorImage& image, const SvgOptions& options, const RunContext& context,
            std::ostream& out)
      : image_(image), options_(options), context_(context), out_(out), cells_(out) {}

  void write() {
    const std::string w = to_text(image_.width), h = to_text(image_.height);
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         << "<svg xmlns=\"http://www.w3.org/2000/svg\" "
            "xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\" width=\"" << w
         << "\" height=\"" << h << "\" viewBox=\"0 0 " << w << ' ' << h << "\" role=\"img\">\n"
         << "<title>" << xml_escaped(options_.title) << "</title>\n"
         << "<g transform=\"scale(" << to_text(1.0 / SvgPathData::kUnitsPerPixel) << ")\">\n";
    for (const Layer& layer : image_.layers) write_layer(layer);
    out_ << "</g>\n</svg>\n";
  }

 private:
  void write_layer(const Layer& source) {
    const SvgLayer layer(source, 2.0 / 255);
    const std::vector<int> translucent = layer.quads(PatchOpacity::translucent);
    const std::vector<int> opaque = layer.quads(PatchOpacity::opaque);
    out_ << "<g>\n";
    if (!translucent.empty()) write_masked(layer, translucent);
    write_underlay(layer);
    write_cells(layer, opaque, CellPaint::color);
    out_ << "</g>\n";
  }

  /// Overlapping translucent cells would add up. So their alpha is painted in opaque grays, seams
  /// under bleed as always, and is then the mask of their colours.
  void write_masked(const SvgLayer& layer, const std::vector<int>& quads) {
    const std::string id = "mask" + std::to_string(mask_count_++);
    constexpr double kUnits = SvgPathData::kUnitsPerPixel;
    out_ << "<mask id=\"" << id << "\" maskUnits=\"userSpaceOnUse\" x=\"0\" y=\"0\" width=\""
         << to_text(image_.width * kUnits) << "\" height=\"" << to_text(image_.height * kUnits)
         << "\">\n";
    write_cells(layer, quads, CellPaint::alpha);
    out_ << "</mask>\n<g mask=\"url(#" << id << ")\">\n";
    write_cells(layer, quads, CellPaint::color);
    out_ << "</g>\n";
  }

  void write_underlay(const SvgLayer& layer) {
    for (const UnderlayGroup& group : underlay_groups(layer, image_.width, image_.height)) {
      CellFill fill;
      fill.base.stops[0] = rounded_color(group.color);
      for (const SvgOutline& outline : group.outlines) cells_.add(outline, fill);
      cells_.finish();
    }
  }

  void write_cells(const SvgLayer& layer, const std::vector<int>& quads, CellPaint paint) {
    const int count = static_cast<int>(quads.size());
    for (int begin = 0; begin < count; begin += kChunk) {
      const int end = std::min(begin + kChunk, count);
      std::vector<std::vector<SvgCell>> painted(end - begin);
      arena_.execute([&] {
        tbb::parallel_for(begin, end,
                          [&](int i) { 
                            painted[i - begin] = divide_into_cells(layer, quads[i], paint, price_, kBleed);
 });
      });
      for (const auto& patch : painted) {
        for (const SvgCell& cell : patch) cells_.add(cell.outline, cell.fill);
      }
      if (paint == CellPaint::color) painted_ += end - begin;
      context_.progress("write SVG", double(painted_) / image_.patch_count());
    }
    cells_.finish();
  }

  const VectorImage& image_;
  const SvgOptions& options_;
  const RunContext& context_;
  std::ostream& out_;
  SvgCellWriter cells_;
  double price_ = options_.tolerance * options_.tolerance;
  tbb::task_arena arena_{arena_size(context_)};
  int mask_count_ = 0;
  int painted_ = 0;
};

}  // namespace

void write_svg(const VectorImage& image, const std::filesystem::path& path,
               const SvgOptions& options, const RunContext& context) {
  if (!(options.tolerance > 0)) {
    throw Error(ErrorCode::invalid_argument, "the SVG tolerance is " + to_text(options.tolerance) +
                                                 "; choose one above 0, such as 4");
  }
  write_stream_atomically(
      path, [&](std::ostream& file) { SvgWriter(image, options, context, file).write(); });
}

}  // namespace quadrille
