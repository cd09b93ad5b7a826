#include "sheet_texture.h"

#include <algorithm>
#include <cmath>

#include "quadrille/renderer.h"
#include "settled_geometry.h"

namespace quadrille {
namespace {

/// A sheet's patches, and around them those that are not torn off: in them, too, paint goes on.
std::vector<char> shown_patches(const SheetedLayer& layer, int sheet) {
  const QuadMesh& mesh = layer.mesh();
  std::vector<char> is_near(mesh.vertex_count(), 0);
  for (int q = 0; q < mesh.quad_count(); ++q) {
    if (layer.sheet(q) != sheet) continue;
    for (const int v : mesh.quads()[q]) is_near[v] = 1;
  }
  std::vector<char> is_shown = layer.torn_off(sheet);
  for (int q = 0; q < mesh.quad_count(); ++q) {
    const auto& corners = mesh.quads()[q];
    const bool is_beside =
        std::any_of(corners.begin(), corners.end(), [&](int v) { return is_near[v]; });
    is_shown[q] = !is_shown[q] && is_beside && layer.is_drawn(q);
  }
  return is_shown;
}

/// The layer without the other patches: they turn transparent, and what separates them from the
/// shown ones is drawn as a tear.
Layer only(const SheetedLayer& layer, const std::vector<char>& is_shown) {
  Layer rest = layer.layer();
  if (std::find(is_shown.begin(), is_shown.end(), 0) == is_shown.end()) return rest;
  settle_geometry(rest, layer.paintable());
  PatchMesh& patches = rest.patches;
  patches.opaque = false;
  const int nothing = static_cast<int>(patches.wedges.size());
  patches.wedges.emplace_back();
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    const bool shows = is_shown[QuadMesh::quad_of(h)];
    if (!shows) patches.wedge_of_corner[h] = nothing;
    const int twin = patches.mesh.twin(h);
    if (twin >= 0 && shows != bool(is_shown[QuadMesh::quad_of(twin)])) {
      patches.mesh.edge_flags[patches.mesh.edge(h)] |= kTearEdge;
    }
  }
  return rest;
}

/// The same layer with every colour changed but that of nothing, its last wedge if it has one.
template <class Change>
Layer repainted(Layer layer, bool has_nothing, const Change& change) {
  auto& wedges = layer.patches.wedges;
  for (std::size_t w = 0; w + (has_nothing ? 1 : 0) < wedges.size(); ++w) {
    for (Color* c : {&wedges[w].value, &wedges[w].dx, &wedges[w].dy, &wedges[w].twist}) {
      *c = change(*c);
    }
    wedges[w].value[3] = 1;
  }
  return layer;
}

/// Premultiplied colours as if they were opaque ones.
Color without_alpha(const Color& c) { return {c[0], c[1], c[2], 0}; }
/// Alpha as an opaque grey.
Color alpha_as_grey(const Color& c) { return {c[3], c[3], c[3], 0}; }

/// Draws the sheet of one layer in bands of texels.
class SheetPainter {
 public:
  SheetPainter(const VectorImage& image, const Layer& shown, bool has_nothing, bool has_alpha)
      : colors_{image.width, image.height, {shown}, {}},
        alphas_{image.width, image.height, {}, {}},
        has_alpha_(has_alpha) {
    if (!has_alpha_) return;
    alphas_.layers = {repainted(shown, has_nothing, alpha_as_grey)};
    colors_.layers = {repainted(shown, has_nothing, without_alpha)};
  }

  /// Straight RGBA of the paint; `known` tells which texels a patch touches.
  void paint(RenderOptions options, Texture& texture, std::vector<std::uint8_t>& known,
             const RunContext& context) const {
    constexpr int kTexelsPerBand = 1 << 22;
    Renderer colors(colors_);
    Renderer alphas(alphas_);
    RunContext quiet;
    quiet.threads = context.threads;
    const PixelRegion whole = *options.region;
    const int rows = std::max(1, kTexelsPerBand / whole.width);
    for (int y = 0; y < whole.height; y += rows) {
      context.progress("texture", double(y) / whole.height);
      const int count = std::min(rows, whole.height - y);
      options.region = PixelRegion{whole.x, whole.y + y, whole.width, count};
      const std::size_t first = std::size_t(y) * whole.width;
      const std::size_t texels = std::size_t(count) * whole.width;
      std::uint8_t* const out = texture.data.data() + 4 * first;
      if (!has_alpha_) {
        colors.draw(options, {SampleType::uint8, 4, false}, {out, 4l * whole.width}, quiet);
        for (std::size_t i = 0; i < texels; ++i) known[first + i] = out[4 * i + 3] > 0;
        for (std::size_t i = 0; i < texels; ++i) out[4 * i + 3] = 255;
        continue;
      }
      const auto color = draw_wide(colors, options, quiet),
                 alpha = draw_wide(alphas, options, quiet);
      for (std::size_t i = 0; i < texels; ++i) {
        known[first + i] = color[4 * i + 3] > 0;
        set_texel(&color[4 * i], alpha[4 * i], out + 4 * i);
      }
    }
    context.progress("texture", 1);
  }

 private:
  static std::vector<std::uint16_t> draw_wide(Renderer& renderer, const RenderOptions& options,
                                              const RunContext& context) {
    const PixelRegion& r = *options.region;
    std::vector<std::uint16_t> samples(std::size_t(4) * r.width * r.height);
    renderer.draw(options, {SampleType::uint16, 4, false}, {samples.data(), 8l * r.width}, context);
    return samples;
  }

  static void set_texel(const std::uint16_t* color, std::uint16_t alpha, std::uint8_t* out) {
    for (int c = 0; c < 3; ++c) {
      const double straight = alpha > 0 ? std::min(1.0, double(color[c]) / alpha) : 0;
      out[c] = static_cast<std::uint8_t>(255 * straight + 0.5);
    }
    const double full = alpha / 257.0;
    // A step short of opaque or transparent is not worth blending.
    out[3] = full > 253.5 ? 255 : full < 1.5 ? 0 : static_cast<std::uint8_t>(full + 0.5);
  }

  VectorImage colors_, alphas_;
  bool has_alpha_;
};

/// The texels that the sheet's patches may touch, and some around for coarser levels of detail.
PixelRegion sheet_region(const SheetedLayer& layer, int sheet, double scale_x, double scale_y,
                         int width, int height) {
  constexpr double kMargin = 8;
  Eigen::Array2d low(width, height), high(0, 0);
  const Eigen::Array2d scale(scale_x, scale_y);
  for (int q = 0; q < layer.mesh().quad_count(); ++q) {
    if (layer.sheet(q) != sheet) continue;
    for (const auto& row : layer.position(q).control) {
      for (const Eigen::Vector2d& p : row) {
        low = low.min(p.array() * scale - kMargin);
        high = high.max(p.array() * scale + kMargin);
      }
    }
  }
  const Eigen::Array2d size(width, height);
  const Eigen::Array2d from = low.max(0).min(size - 1).floor();
  const Eigen::Array2d to = high.min(size).max(from + 1).ceil();
  return {int(from.x()), int(from.y()), int(to.x() - from.x()), int(to.y() - from.y())};
}

AlphaMode alpha_mode(const Texture& texture, const std::vector<std::uint8_t>& known) {
  AlphaMode mode = AlphaMode::opaque;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::uint8_t alpha = texture.data[4 * i + 3];
    if (!known[i] || alpha == 255) continue;
    if (alpha != 0) return AlphaMode::blend;
    mode = AlphaMode::mask;
  }
  return mode;
}

void drop_alpha(Texture& texture) {
  const std::size_t texels = texture.data.size() / 4;
  for (std::size_t i = 0; i < texels; ++i) {
    std::copy_n(&texture.data[4 * i], 3, &texture.data[3 * i]);
  }
  texture.data.resize(3 * texels);
  texture.channels = 3;
}

}  // namespace

SheetTexture sheet_texture(const VectorImage& image, const SheetedLayer& layer, int sheet,
                           double texels_per_pixel, const RunContext& context) {
  RenderOptions options;
  const double side = std::max(image.width, image.height);
  options.scale = std::min(texels_per_pixel, kMaxTextureSide / side);
  SheetTexture result;
  const auto [width, height] = output_size(image, options);
  result.picture_width = width;
  result.picture_height = height;
  result.region = sheet == 0 ? PixelRegion{0, 0, width, height}
                             : sheet_region(layer, sheet, width / image.width,
                                            height / image.height, width, height);
  options.region = result.region;

  Texture& texture = result.texture;
  texture = {result.region.width, result.region.height, 4, {}};
  const std::size_t texels = std::size_t(texture.width) * texture.height;
  texture.data.resize(4 * texels);
  std::vector<std::uint8_t> known(texels);
  const std::vector<char> is_shown = shown_patches(layer, sheet);
  const bool has_nothing = std::find(is_shown.begin(), is_shown.end(), 0) != is_shown.end();
  SheetPainter(image, only(layer, is_shown), has_nothing, !layer.layer().patches.opaque)
      .paint(options, texture, known, context);

  result.alpha_mode = alpha_mode(texture, known);
  if (result.alpha_mode == AlphaMode::opaque) {
    drop_alpha(texture);
    fill_unknown(texture, 0, 3, known);
    return result;
  }
  result.is_near = fill_unknown(texture, 3, 1, known);
  for (std::size_t i = 0; i < texels; ++i) {
    if (texture.data[4 * i + 3] == 0) known[i] = 0;
  }
  fill_unknown(texture, 0, 3, known);
  return result;
}

}  // namespace quadrille
