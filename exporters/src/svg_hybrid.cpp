#include "svg_hybrid.h"

#include <glib.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "paint_groups.h"
#include "sheet_texture.h"
#include "sheeted_layer.h"
#include "svg_clip.h"
#include "svg_path.h"
#include "svg_text.h"
#include "texture_file.h"

namespace quadrille {
namespace {

constexpr int kUnitsPerPixel = 8;
constexpr double kTexelsPerPixel = 1;

/// The sheet's alpha as an opaque gray picture. It has none away from its patches: where they end
/// the layer, programs that clip twice at the same edge would let it through.
Texture alpha_of(const SheetTexture& sheet) {
  const Texture& texture = sheet.texture;
  Texture gray{texture.width, texture.height, 3, {}};
  const std::size_t texels = std::size_t(texture.width) * texture.height;
  gray.data.resize(3 * texels, 255);
  for (std::size_t i = 0; texture.channels == 4 && i < texels; ++i) {
    const std::uint8_t alpha = sheet.is_near[i] ? texture.data[4 * i + 3] : 0;
    for (int c = 0; c < 3; ++c) gray.data[3 * i + c] = alpha;
  }
  return gray;
}

Texture colors_of(const SheetTexture& sheet) {
  const Texture& texture = sheet.texture;
  if (texture.channels == 3) return texture;
  Texture colors{texture.width, texture.height, 3, {}};
  const std::size_t texels = std::size_t(texture.width) * texture.height;
  colors.data.reserve(3 * texels);
  for (std::size_t i = 0; i < texels; ++i) {
    const auto* texel = &texture.data[4 * i];
    colors.data.insert(colors.data.end(), texel, texel + 3);
  }
  return colors;
}

std::string data_uri(const EncodedTexture& file) {
  const std::unique_ptr<gchar, decltype(&g_free)> text(
      g_base64_encode(file.bytes.data(), file.bytes.size()), g_free);
  return std::string("data:") + file.mime_type + ";base64," + text.get();
}

/// What ends the layer as a whole; empty when that is the picture's border.
std::vector<EdgeLoop> layer_outline(const SheetedLayer& layer, double width, double height) {
  std::vector<char> inside(layer.mesh().quad_count());
  for (int q = 0; q < layer.mesh().quad_count(); ++q) inside[q] = layer.is_drawn(q);
  const bool is_whole = std::find(inside.begin(), inside.end(), 0) == inside.end();
  if (is_whole && fills_picture(layer.layer(), width, height)) return {};
  return border_of(layer.mesh(), inside);
}

/// What ends a sheet toward earlier ones. It goes on where later ones paint over it, and beyond the
/// outline of its patches, where that of the layer ends it. Empty for the first sheet.
std::vector<EdgeLoop> sheet_outline(const SheetedLayer& layer, int sheet) {
  if (sheet == 0) return {};
  const QuadMesh& mesh = layer.mesh();
  std::vector<char> inside(mesh.quad_count(), 0), touched(mesh.vertex_count(), 0);
  for (int q = 0; q < mesh.quad_count(); ++q) {
    if (layer.sheet(q) != sheet) continue;
    for (const int v : mesh.quads()[q]) touched[v] = 1;
  }
  for (int q = 0; q < mesh.quad_count(); ++q) {
    const auto& corners = mesh.quads()[q];
    if (layer.is_drawn(q)) {
      const bool is_beside =
          std::any_of(corners.begin(), corners.end(), [&](int v) { return touched[v]; });
      inside[q] = is_beside && layer.sheet(q) >= sheet;
      continue;
    }
    bool is_next = false, is_next_to_earlier = false;
    for (int h = 4 * q; h < 4 * q + 4; ++h) {
      const int other = mesh.twin(h) < 0 ? -1 : layer.sheet(QuadMesh::quad_of(mesh.twin(h)));
      is_next = is_next || other == sheet;
      is_next_to_earlier = is_next_to_earlier || (other >= 0 && other < sheet);
    }
    inside[q] = is_next && !is_next_to_earlier && layer.paintable()[q];
  }
  return border_of(mesh, inside);
}

class HybridSvgWriter {
 public:
  HybridSvgWriter(std::ostream& out, const VectorImage& image, const RunContext& context)
      : out_(out), image_(image), context_(context) {
    quiet_.threads = context.threads;
  }

  void write(const std::string& title) {
    out_ << svg_head(image_.width, image_.height, title) << "<g transform=\"scale("
         << to_text(1.0 / kUnitsPerPixel) << ")\">\n";
    for (std::size_t k = 0; k < image_.layers.size(); ++k) {
      layers_done_ = double(k) / image_.layers.size();
      write_layer(image_.layers[k], "layer-" + to_text(static_cast<long long>(k + 1)));
    }
    out_ << "</g>\n</svg>\n";
  }

 private:
  void write_layer(const Layer& source, const std::string& id) {
    const SheetedLayer layer(source, Unpaintable::hide);
    std::vector<SheetTexture> textures;
    for (int sheet = 0; sheet < layer.sheet_count(); ++sheet) {
      context_.progress("write SVG",
                        layers_done_ + double(sheet) / layer.sheet_count() / image_.layers.size());
      textures.push_back(sheet_texture(image_, layer, sheet, kTexelsPerPixel, quiet_));
    }
    const std::vector<EdgeLoop> outline = layer_outline(layer, image_.width, image_.height);
    out_ << "<g id=\"" << id << "\">\n";
    if (source.patches.opaque) {
      begin_clip(layer, outline, id);
      write_sheets(layer, textures, id, colors_of);
    } else {
      out_ << "<mask id=\"" << id
           << "-alpha\" maskUnits=\"userSpaceOnUse\" x=\"0\" y=\"0\" width=\""
           << to_text(image_.width * kUnitsPerPixel) << "\" height=\""
           << to_text(image_.height * kUnitsPerPixel) << "\">\n";
      begin_clip(layer, outline, id);
      write_sheets(layer, textures, id + "-alpha", alpha_of);
      out_ << "</g>\n</mask>\n<g mask=\"url(#" << id << "-alpha)\">\n";
      write_sheets(layer, textures, id, colors_of);
    }
    out_ << "</g>\n</g>\n";
  }

  /// Begins a group that ends at the loops, if there are any.
  void begin_clip(const SheetedLayer& layer, const std::vector<EdgeLoop>& loops,
                  const std::string& id) {
    if (loops.empty()) {
      out_ << "<g>\n";
      return;
    }
    SvgPathData path(kUnitsPerPixel);
    for (const EdgeLoop& loop : loops) path.append(clip_outline(layer.layer(), loop));
    out_ << "<clipPath id=\"" << id << "-clip\"><path d=\"" << path.text()
         << "\"/></clipPath>\n<g clip-path=\"url(#" << id << "-clip)\">\n";
  }

  void write_sheets(const SheetedLayer& layer, const std::vector<SheetTexture>& textures,
                    const std::string& id, Texture (*channels)(const SheetTexture&)) {
    for (int sheet = 0; sheet < layer.sheet_count(); ++sheet) {
      begin_clip(layer, sheet_outline(layer, sheet),
                 id + "-sheet-" + to_text(static_cast<long long>(sheet + 1)));
      write_image(textures[sheet], channels(textures[sheet]));
      out_ << "</g>\n";
    }
  }

  void write_image(const SheetTexture& sheet, const Texture& texture) {
    const double x = kUnitsPerPixel * image_.width / sheet.picture_width;
    const double y = kUnitsPerPixel * image_.height / sheet.picture_height;
    out_ << "<image x=\"" << to_text(sheet.region.x * x) << "\" y=\"" << to_text(sheet.region.y * y)
         << "\" width=\"" << to_text(sheet.region.width * x) << "\" height=\""
         << to_text(sheet.region.height * y) << "\" preserveAspectRatio=\"none\" xlink:href=\""
         << data_uri(encode(texture, GltfTextureFormat::png, 0, quiet_)) << "\"/>\n";
  }

  std::ostream& out_;
  const VectorImage& image_;
  const RunContext& context_;
  RunContext quiet_;  ///< the stages inside have no progress of their own
  double layers_done_ = 0;
};

}  // namespace

void write_hybrid_svg(std::ostream& out, const VectorImage& image, const std::string& title,
                      const RunContext& context) {
  HybridSvgWriter(out, image, context).write(title);
}

}  // namespace quadrille
