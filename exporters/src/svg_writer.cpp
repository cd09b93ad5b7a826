#include "svg_writer.h"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "arena_size.h"
#include "svg_calm.h"
#include "svg_cell_writer.h"
#include "svg_clip.h"
#include "svg_layer.h"
#include "svg_paint.h"
#include "svg_text.h"
#include "svg_underlay.h"

namespace quadrille {
namespace {

/// Alpha within this of 0 or 1 counts as such.
constexpr double kAlphaTolerance = 2.0 / 255;

class SvgWriter {
 public:
  SvgWriter(const VectorImage& image, const SvgDetail& detail, const RunContext& context,
            std::ostream& out)
      : image_(image), detail_(detail), context_(context), out_(out), cells_(out, detail) {}

  void write(const std::string& title) {
    out_ << svg_head(image_.width, image_.height, title) << "<g transform=\"scale("
         << to_text(1.0 / detail_.units_per_pixel) << ")\">\n";
    for (const Layer& layer : image_.layers) write_layer(layer);
    out_ << "</g>\n</svg>\n";
  }

 private:
  void write_layer(const Layer& source) {
    const SvgLayer layer(source, kAlphaTolerance, image_.width, image_.height);
    layer_detail_ = {detail_.price / banding_weight(layer), detail_.units_per_pixel};
    const std::string id = "layer-" + std::to_string(++layer_count_);
    out_ << "<g id=\"" << id << "\">\n";
    const std::vector<int> translucent = layer.quads(PatchOpacity::translucent);
    if (!translucent.empty()) write_masked(layer, translucent, id);
    write_underlay(opaque_underlay(layer, image_.width, image_.height), id);
    write_regions(layer, layer.quads(PatchOpacity::opaque));
    out_ << "</g>\n";
  }

  /// Overlapping translucent cells would add up. So their alpha is painted in opaque grays, seams
  /// under bleed as always, and is then the mask of their colours.
  void write_masked(const SvgLayer& layer, const std::vector<int>& quads, const std::string& id) {
    open_mask(id + "-alpha");
    add_underlay(mask_underlay(layer, image_.width, image_.height));
    write_cells(layer, quads, CellPaint::alpha);
    out_ << "</mask>\n<g id=\"" << id << "-translucent\" mask=\"url(#" << id << "-alpha)\">\n";
    write_underlay(translucent_underlay(layer), id + "-translucent");
    write_cells(layer, quads, CellPaint::color);
    out_ << "</g>\n";
  }

  void open_mask(const std::string& id) {
    const double units = detail_.units_per_pixel;
    out_ << "<mask id=\"" << id << "\" maskUnits=\"userSpaceOnUse\" x=\"0\" y=\"0\" width=\""
         << to_text(image_.width * units) << "\" height=\"" << to_text(image_.height * units)
         << "\">\n";
  }

  void write_underlay(const std::vector<UnderlayGroup>& groups, const std::string& id) {
    out_ << "<g id=\"" << id << "-underlay\">\n";
    for (const UnderlayGroup& group : groups) add_underlay(group);
    cells_.finish();
    out_ << "</g>\n";
  }

  void add_underlay(const UnderlayGroup& group) {
    if (group.outlines.empty()) return;
    CellFill fill;
    fill.base.stops[0].color = rounded_color(group.color);
    cells_.add(group.outlines, fill);
  }

  void write_regions(const SvgLayer& layer, const std::vector<int>& quads) {
    const auto end_of = [&](auto begin, const auto& number) {
      return std::find_if(begin, quads.end(), [&](int q) { return number(q) != number(*begin); });
    };
    for (auto begin = quads.begin(); begin != quads.end();) {
      const auto region_end = end_of(begin, [&](int q) { return layer.region(q); });
      const std::string id = "region-" + to_text(static_cast<long long>(++region_count_));
      out_ << "<g id=\"" << id << "\">\n";
      while (begin != region_end) {
        const auto end = end_of(begin, [&](int q) { return layer.part(q); });
        write_part(layer, {begin, end}, id);
        begin = end;
      }
      out_ << "</g>\n";
    }
  }

  /// A mask ends a part where tears and the outline do. Of a clip path most viewers cut every cell
  /// on its own, and where several overlap in a pixel at its edge, their shares of it add up.
  void write_part(const SvgLayer& layer, const std::vector<int>& quads, const std::string& region) {
    const int part = layer.part(quads.front());
    const std::vector<EdgeLoop> clip = layer.clip(part);
    if (!clip.empty()) {
      const std::string id = region + "-mask-" + to_text(static_cast<long long>(part + 1));
      SvgPathData path(detail_.units_per_pixel);
      for (const EdgeLoop& loop : clip) path.append(clip_outline(layer.layer(), loop));
      open_mask(id);
      out_ << "<path fill=\"#ffffff\" d=\"" << path.text() << "\"/></mask>\n<g mask=\"url(#" << id
           << ")\">\n";
    }
    write_cells(layer, quads, CellPaint::color);
    if (!clip.empty()) out_ << "</g>\n";
  }

  void write_cells(const SvgLayer& layer, const std::vector<int>& quads, CellPaint paint) {
    for (auto begin = quads.begin(); begin != quads.end();) {
      const auto end = std::find_if(begin, quads.end(),
                                    [&](int q) { return layer.tile(q) != layer.tile(*begin); });
      const std::vector<SvgPaint> paints = arena_.execute([&] {
        return paint_patches(layer, {begin, end}, paint, layer_detail_);
      });
      for (const SvgPaint& one : paints) cells_.add(one.outlines, one.fill);
      if (paint == CellPaint::color) painted_ += static_cast<int>(end - begin);
      context_.progress("write SVG", double(painted_) / image_.patch_count());
      begin = end;
    }
    cells_.finish();
  }

  const VectorImage& image_;
  const SvgDetail& detail_;
  SvgDetail layer_detail_ = {};
  const RunContext& context_;
  std::ostream& out_;
  SvgCellWriter cells_;
  tbb::task_arena arena_{arena_size(context_)};
  int layer_count_ = 0, region_count_ = 0, painted_ = 0;
};

}  // namespace

void write_svg_text(const VectorImage& image, const std::string& title, const SvgDetail& detail,
                    const RunContext& context, std::ostream& out) {
  SvgWriter(image, detail, context, out).write(title);
}

}  // namespace quadrille
