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

/// The alpha of a texture as an opaque gray picture.
Texture alpha_of(const Texture& texture) {
  Texture gray{texture.width, texture.height, 3, {}};
  const std::size_t texels = std::size_t(texture.width) * texture.height;
  gray.data.resize(3 * texels, 255);
  for (std::size_t i = 0; texture.channels == 4 && i < texels; ++i) {
    for (int c = 0; c < 3; ++c) gray.data[3 * i + c] = texture.data[4 * i + 3];
  }
  return gray;
}

Texture colors_of(const Texture& texture) {
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

/// The outline of what a sheet shows: its patches, and those of later sheets around them, which
/// paint over it. `to_outline` tells whether it ends at the outline of the layer, too; the first
/// sheet goes on where it does not. Empty when nothing ends it.
std::vector<EdgeLoop> sheet_outline(const SheetedLayer& layer, int sheet, bool to_outline,
                                    bool fills) {
  const QuadMesh& mesh = layer.mesh();
  std::vector<char> inside(mesh.quad_count()), touched(mesh.vertex_count(), 0);
  for (int q = 0; q < mesh.quad_count(); ++q) {
    if (layer.sheet(q) != sheet) continue;
    for (const int v : mesh.quads()[q]) touched[v] = 1;
  }
  bool is_whole = true;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    const auto& corners = mesh.quads()[q];
    const bool is_beside = sheet == 0 || std::any_of(corners.begin(), corners.end(),
                                                     [&](int v) { return touched[v]; });
    inside[q] = layer.is_drawn(q) ? layer.sheet(q) >= sheet && is_beside : !to_outline;
    is_whole = is_whole && inside[q];
  }
  const bool ends = !is_whole || (to_outline && !fills);
  return ends ? border_of(mesh, inside) : std::vector<EdgeLoop>{};
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
    const SheetedLayer layer(source);
    std::vector<SheetTexture> textures;
    for (int sheet = 0; sheet < layer.sheet_count(); ++sheet) {
      context_.progress("write SVG",
                        layers_done_ + double(sheet) / layer.sheet_count() / image_.layers.size());
      textures.push_back(sheet_texture(image_, layer, sheet, kTexelsPerPixel, quiet_));
    }
    out_ << "<g id=\"" << id << "\">\n";
    if (source.patches.opaque) {
      write_sheets(layer, textures, id, colors_of, true);
    } else {
      out_ << "<mask id=\"" << id
           << "-alpha\" maskUnits=\"userSpaceOnUse\" x=\"0\" y=\"0\" width=\""
           << to_text(image_.width * kUnitsPerPixel) << "\" height=\""
           << to_text(image_.height * kUnitsPerPixel) << "\">\n";
      write_sheets(layer, textures, id + "-alpha", alpha_of, true);
      out_ << "</mask>\n<g mask=\"url(#" << id << "-alpha)\">\n";
      write_sheets(layer, textures, id, colors_of, false);  // the mask has the outline
      out_ << "</g>\n";
    }
    out_ << "</g>\n";
  }

  void write_sheets(const SheetedLayer& layer, const std::vector<SheetTexture>& textures,
                    const std::string& id, Texture (*channels)(const Texture&), bool to_outline) {
    const bool fills = fills_picture(layer.layer(), image_.width, image_.height);
    for (int sheet = 0; sheet < layer.sheet_count(); ++sheet) {
      const std::string name = id + "-sheet-" + to_text(static_cast<long long>(sheet + 1));
      const std::vector<EdgeLoop> clip = sheet_outline(layer, sheet, to_outline, fills);
      if (!clip.empty()) {
        SvgPathData path(kUnitsPerPixel);
        for (const EdgeLoop& loop : clip) path.append(clip_outline(layer.layer(), loop));
        out_ << "<clipPath id=\"" << name << "-clip\"><path d=\"" << path.text()
             << "\"/></clipPath>\n";
      }
      out_ << "<g id=\"" << name << "\"";
      if (!clip.empty()) out_ << " clip-path=\"url(#" << name << "-clip)\"";
      out_ << ">";
      write_image(textures[sheet], channels(textures[sheet].texture));
      out_ << "</g>\n";
    }
  }

  void write_image(const SheetTexture& sheet, const Texture& texture) {
    const double x = kUnitsPerPixel * image_.width / sheet.picture_width;
    const double y = kUnitsPerPixel * image_.height / sheet.picture_height;
    out_ << "<image x=\"" << to_text(sheet.region.x * x) << "\" y=\"" << to_text(sheet.region.y * y)
         << "\" width=\"" << to_text(sheet.region.width * x) << "\" height=\""
         << to_text(sheet.region.height * y) << "\" preserveAspectRatio=\"none\" xlink:href=\""
         << data_uri(encode(texture, GltfTextureFormat::png, 0, quiet_)) << "\"/>";
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
