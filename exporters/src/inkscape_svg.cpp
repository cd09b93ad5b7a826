#include "inkscape_svg.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "inkscape_mesh.h"
#include "inkscape_outline.h"
#include "paintable_patch.h"
#include "patch_opacity.h"
#include "svg_text.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

/// How far an outline goes on under what is painted later, and a mesh beyond the outline, whose
/// pixels it must fill, in pixels.
constexpr double kOutlineBleed = 1, kMeshBleed = 1.5;
/// Colour error in 8-bit steps, see is_faithful_bicubic() and divisions_of().
constexpr double kTolerance = 12;
/// The share of the work that is done when the grids of a layer are found.
constexpr double kFinding = 0.5;

std::string text_of(const Vector2d& p) {
  constexpr int kDecimals = 3;
  return to_short_text(p.x(), kDecimals) + ' ' + to_short_text(p.y(), kDecimals);
}

/// The straight colour as #rrggbb.
std::string hex_of(const Color& color) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (int c = 0; c < 3; ++c) {
    const float straight = color[3] > 0 ? std::min(color[c] / color[3], 1.0f) : 0.0f;
    const auto byte = static_cast<int>(std::lround(255 * straight));
    text += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return text;
}

class MeshGradientWriter {
 public:
  MeshGradientWriter(std::ostream& out, const InkscapeMesh& mesh) : out_(out), mesh_(mesh) {}

  void write(const std::string& id) {
    out_ << "<meshgradient id=\"" << id << "\" gradientUnits=\"userSpaceOnUse\" x=\""
         << to_short_text(mesh_.nodes.front().x(), 3) << "\" y=\""
         << to_short_text(mesh_.nodes.front().y(), 3) << '"'
         << (mesh_.bicubic ? " type=\"bicubic\"" : "") << ">\n";
    for (int row = 0; row < mesh_.rows; ++row) {
      out_ << "<meshrow>";
      for (int column = 0; column < mesh_.columns; ++column) write_patch(column, row);
      out_ << "</meshrow>\n";
    }
    out_ << "</meshgradient>\n";
  }

 private:
  /// A patch has its sides clockwise from the top, each with the colour where it starts, without
  /// those that the patches above and to the left of it have.
  void write_patch(int column, int row) {
    const auto corner = [&](int i, int j) { return mesh_.node(column + i, row + j); };
    const PlaneCurve& bottom = mesh_.across[mesh_.side_across(column, row + 1)];
    const PlaneCurve& left = mesh_.down[mesh_.side_down(column, row)];
    out_ << "<meshpatch>";
    if (row == 0) {
      write_stop(mesh_.across[mesh_.side_across(column, 0)], column == 0 ? corner(0, 0) : -1);
    }
    write_stop(mesh_.down[mesh_.side_down(column + 1, row)], row == 0 ? corner(1, 0) : -1);
    write_stop({bottom[3], bottom[2], bottom[1], bottom[0]}, corner(1, 1));
    if (column == 0) write_stop({left[3], left[2], left[1], left[0]}, corner(0, 1));
    out_ << "</meshpatch>";
  }

  void write_stop(const PlaneCurve& side, int node) {
    out_ << "<stop path=\"C " << text_of(side[1]) << ' ' << text_of(side[2]) << ' '
         << text_of(side[3]) << '"';
    if (node >= 0) {
      const Color& color = mesh_.colors[node];
      out_ << " stop-color=\"" << hex_of(color) << '"';
      if (color[3] < 1) out_ << " stop-opacity=\"" << to_short_text(color[3], 4) << '"';
    }
    out_ << "/>";
  }

  std::ostream& out_;
  const InkscapeMesh& mesh_;
};

class InkscapeSvgWriter {
 public:
  InkscapeSvgWriter(std::ostream& out, const VectorImage& image, const RunContext& context)
      : out_(out), image_(image), context_(context) {}

  void write(const std::string& title) {
    out_ << svg_head(image_.width, image_.height, title);
    for (std::size_t k = 0; k < image_.layers.size(); ++k) {
      out_ << "<g id=\"layer-" << to_text(static_cast<long long>(k + 1)) << "\">\n<title>"
           << xml_escaped(image_.layers[k].name) << "</title>\n";
      write_layer(image_.layers[k]);
      out_ << "</g>\n";
    }
    out_ << "</svg>\n";
  }

 private:
  void write_layer(const Layer& layer) {
    const QuadMesh& mesh = layer.patches.mesh;
    // Half the tolerance is as good as nothing or all.
    const std::vector<PatchOpacity> opacity =
        paint_opacities(layer.patches, 0.5 * kTolerance / 255, paintable_patches(layer));
    std::vector<unsigned char> kinds(opacity.size());
    std::ranges::transform(opacity, kinds.begin(),
                           [](PatchOpacity o) { return static_cast<unsigned char>(o); });
    std::vector<QuadGrid> grids = regular_grids(
        mesh, kinds, [&](double part) { report(kFinding * part * mesh.quad_count()); });
    // Translucent ones first, so that they can reach under the opaque ones.
    const auto opacity_of = [&](const QuadGrid& grid) {
      return opacity[QuadMesh::quad_of(grid.tops.front())];
    };
    std::ranges::stable_sort(grids, {}, opacity_of);

    std::vector<int> grid_of(mesh.quad_count(), -1);
    for (std::size_t g = 0; g < grids.size(); ++g) {
      for (const int h : grids[g].tops) grid_of[QuadMesh::quad_of(h)] = static_cast<int>(g);
    }
    const auto goes_under = [&](int h) {
      const int twin = mesh.twin(h);
      return twin >= 0 && opacity[QuadMesh::quad_of(twin)] == PatchOpacity::opaque &&
             grid_of[QuadMesh::quad_of(twin)] > grid_of[QuadMesh::quad_of(h)];
    };
    int written = 0;
    for (const QuadGrid& grid : grids) {
      const PlacedGrid placed(layer, grid);
      write_grid(inkscape_mesh(placed, kMeshBleed, kTolerance),
                 grid_outline(layer, grid, placed, kOutlineBleed, goes_under));
      written += static_cast<int>(grid.tops.size());
      report(kFinding * mesh.quad_count() + (1 - kFinding) * written);
    }
    layers_done_ += mesh.quad_count();
  }

  /// So many patches of the layer are done.
  void report(double patches) const {
    context_.progress("write SVG", (layers_done_ + patches) / image_.patch_count());
  }

  void write_grid(const InkscapeMesh& mesh, const SvgOutline& outline) {
    const std::string number = std::to_string(++grid_count_);
    out_ << "<defs>\n";
    MeshGradientWriter(out_, mesh).write("mesh-" + number);
    out_ << "</defs>\n<path id=\"grid-" << number << "\" fill=\"url(#mesh-" << number << ") "
         << hex_of(mean_color(mesh)) << "\" d=\"M" << text_of(outline.start);
    for (const SvgOutline::Piece& piece : outline.pieces) {
      if (piece.is_line) {
        out_ << 'L' << text_of(piece.end);
      } else {
        out_ << 'C' << text_of(piece.control1) << ' ' << text_of(piece.control2) << ' '
             << text_of(piece.end);
      }
    }
    out_ << "Z\"/>\n";
  }

  static Color mean_color(const InkscapeMesh& mesh) {
    Color sum = Color::Zero();
    for (const Color& color : mesh.colors) sum += color;
    return sum / static_cast<float>(mesh.colors.size());
  }

  std::ostream& out_;
  const VectorImage& image_;
  const RunContext& context_;
  int grid_count_ = 0;
  int layers_done_ = 0;  ///< patches of the layers before
};

}  // namespace

void write_inkscape_svg(std::ostream& out, const VectorImage& image, const std::string& title,
                        const RunContext& context) {
  InkscapeSvgWriter(out, image, context).write(title);
}

}  // namespace quadrille
