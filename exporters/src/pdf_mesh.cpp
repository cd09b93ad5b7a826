#include "pdf_mesh.h"

#include <cairo-pdf.h>
#include <cairo.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "arena_size.h"
#include "patch_opacity.h"
#include "quadrille/error.h"
#include "quadrille/mesh_region.h"
#include "subdivision.h"

namespace quadrille {
namespace {

/// Points per inch of a PDF's user space.
constexpr double kPointsPerInch = 72;
/// Sub-patches are not made shorter than this, in pixels of the picture, nor more along a side.
constexpr double kSmallestSide = 1;
constexpr int kMostDivisions = 32;
/// Patches of one mesh pattern.
constexpr int kChunk = 2048;

struct SubPatch {
  BicubicBezier<Eigen::Vector2d> position;
  std::array<Color, 4> corner;  ///< straight colour
};

Color straight(const Color& premultiplied) {
  const float alpha = std::clamp(premultiplied[3], 0.0f, 1.0f);
  Color color = (premultiplied / std::max(alpha, 1e-3f)).cwiseMax(0.0f).cwiseMin(1.0f);
  color[3] = alpha;
  return color;
}

/// The divisions whose parts are about kSmallestSide long.
Divisions finest(const BicubicBezier<Eigen::Vector2d>& position) {
  const auto parts = [&](int side) {
    const PlaneCurve a = side_curve(position, side), b = side_curve(position, side + 2);
    const double length = std::max((a[3] - a[0]).norm(), (b[3] - b[0]).norm());
    return std::clamp(static_cast<int>(std::ceil(length / kSmallestSide)), 1, kMostDivisions);
  };
  return {parts(0), parts(1)};
}

std::vector<SubPatch> divide(const Layer& layer, int quad, std::optional<double> tolerance) {
  const BicubicBezier<Eigen::Vector2d> position = to_bezier(placed_geometry(layer, quad));
  const BicubicBezier<Color> color = to_bezier(ferguson_patch(layer.patches, quad).color);
  const Divisions count =
      tolerance ? bilinear_divisions(color, *tolerance, finest(position)) : Divisions{};
  std::vector<SubPatch> parts;
  for (int j = 0; j < count.v; ++j) {
    for (int i = 0; i < count.u; ++i) {
      const ParameterBox box{double(i) / count.u, double(j) / count.v, double(i + 1) / count.u,
                             double(j + 1) / count.v};
      parts.push_back({sub_patch(position, box),
                       {straight(color.at(box.u0, box.v0)), straight(color.at(box.u1, box.v0)),
                        straight(color.at(box.u1, box.v1)), straight(color.at(box.u0, box.v1))}});
    }
  }
  return parts;
}

void add_to_mesh(cairo_pattern_t* mesh, const SubPatch& part, bool opaque) {
  const auto& p = part.position.control;
  const auto curve = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                         const Eigen::Vector2d& end) {
    cairo_mesh_pattern_curve_to(mesh, a.x(), a.y(), b.x(), b.y(), end.x(), end.y());
  };
  cairo_mesh_pattern_begin_patch(mesh);
  cairo_mesh_pattern_move_to(mesh, p[0][0].x(), p[0][0].y());
  curve(p[0][1], p[0][2], p[0][3]);
  curve(p[1][3], p[2][3], p[3][3]);
  curve(p[3][2], p[3][1], p[3][0]);
  curve(p[2][0], p[1][0], p[0][0]);
  cairo_mesh_pattern_set_control_point(mesh, 0, p[1][1].x(), p[1][1].y());
  cairo_mesh_pattern_set_control_point(mesh, 1, p[1][2].x(), p[1][2].y());
  cairo_mesh_pattern_set_control_point(mesh, 2, p[2][2].x(), p[2][2].y());
  cairo_mesh_pattern_set_control_point(mesh, 3, p[2][1].x(), p[2][1].y());
  for (int k = 0; k < 4; ++k) {
    const Color& c = part.corner[k];
    if (opaque) {
      cairo_mesh_pattern_set_corner_color_rgb(mesh, k, c[0], c[1], c[2]);
    } else {
      cairo_mesh_pattern_set_corner_color_rgba(mesh, k, c[0], c[1], c[2], c[3]);
    }
  }
  cairo_mesh_pattern_end_patch(mesh);
}

template <auto destroy>
struct Destroyer {
  template <class T>
  void operator()(T* object) const {
    destroy(object);
  }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroyer<cairo_surface_destroy>>;
using Drawing = std::unique_ptr<cairo_t, Destroyer<cairo_destroy>>;
using Pattern = std::unique_ptr<cairo_pattern_t, Destroyer<cairo_pattern_destroy>>;

cairo_status_t append(void* target, const unsigned char* bytes, unsigned count) {
  auto& all = *static_cast<std::vector<unsigned char>*>(target);
  all.insert(all.end(), bytes, bytes + count);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw Error(ErrorCode::io_failure, std::string("the PDF could not be drawn: ") +
                                         cairo_status_to_string(status) +
                                         "; export a smaller picture or another format");
}

/// Clips to the border of the layer's patches. Viewers do not anti-alias meshes but paint every
/// pixel that they touch; clips they do anti-alias.
void clip_to_border(cairo_t* drawing, const Layer& layer) {
  const PatchMesh& patches = layer.patches;
  const QuadMesh& mesh = patches.mesh;
  for (const std::vector<int>& loop : border_loops(mesh)) {
    const Eigen::Vector2d start = layer.transform * mesh.vertices[loop.front()];
    cairo_move_to(drawing, start.x(), start.y());
    for (const int v : loop) {
      const int h = mesh.fan(v).front();
      const Eigen::Vector2d &from = mesh.vertices[v], &to = mesh.vertices[mesh.tip(h)];
      const Eigen::Vector2d a = layer.transform * (from + tangent_along(patches, h, 0) / 3),
                            b = layer.transform * (to - tangent_along(patches, h, 1) / 3),
                            end = layer.transform * to;
      cairo_curve_to(drawing, a.x(), a.y(), b.x(), b.y(), end.x(), end.y());
    }
    cairo_close_path(drawing);
  }
  cairo_clip(drawing);
}

class PdfPainter {
 public:
  PdfPainter(cairo_t* drawing, const VectorImage& image, const PdfOptions& options,
             const RunContext& context)
      : drawing_(drawing), image_(image), options_(options), context_(context) {}

  void paint() {
    const double tolerance = options_.tolerance / 255;
    for (const Layer& layer : image_.layers) {
      cairo_save(drawing_);
      if (!fills_page(layer)) clip_to_border(drawing_, layer);
      const std::vector<PatchOpacity> opacities = patch_opacities(layer.patches, 0.5 * tolerance);
      const std::vector<int> opaque = patches_with(opacities, PatchOpacity::opaque);
      const std::vector<int> translucent = patches_with(opacities, PatchOpacity::translucent);
      // Where neighbours are divided differently, viewers may leave out single pixels along their
      // common edge. Whole patches underneath show nearly the right colour there.
      paint_patches({layer, opaque, true, {}});
      paint_patches({layer, opaque, true, tolerance});
      paint_patches({layer, translucent, false, tolerance});
      cairo_restore(drawing_);
    }
  }

 private:
  bool fills_page(const Layer& layer) const {
    return layer.transform.isApprox(Eigen::Affine2d::Identity(), 1e-12) &&
           validate(layer.patches.mesh, image_.width, image_.height).empty();
  }

  struct Task {
    const Layer& layer;
    const std::vector<int>& quads;
    bool opaque;
    std::optional<double> tolerance;  ///< patches stay whole without
  };

  void paint_patches(const Task& task) {
    const int count = static_cast<int>(task.quads.size());
    for (int begin = 0; begin < count; begin += kChunk) {
      const int end = std::min(begin + kChunk, count);
      std::vector<std::vector<SubPatch>> divided(end - begin);
      arena_.execute([&] {
        tbb::parallel_for(begin, end, [&](int i) {
          divided[i - begin] = divide(task.layer, task.quads[i], task.tolerance);
        });
      });
      const Pattern mesh(cairo_pattern_create_mesh());
      for (const auto& parts : divided) {
        for (const SubPatch& part : parts) add_to_mesh(mesh.get(), part, task.opaque);
      }
      require(cairo_pattern_status(mesh.get()));
      cairo_set_source(drawing_, mesh.get());
      cairo_paint(drawing_);
      require(cairo_status(drawing_));
      if (task.tolerance) painted_ += end - begin;
      context_.progress("write PDF", double(painted_) / image_.patch_count());
    }
  }

  cairo_t* drawing_;
  const VectorImage& image_;
  const PdfOptions& options_;
  const RunContext& context_;
  tbb::task_arena arena_{arena_size(context_)};
  int painted_ = 0;
};

}  // namespace

std::vector<unsigned char> draw_pdf(const VectorImage& image, const PdfOptions& options,
                                    const RunContext& context) {
  std::vector<unsigned char> bytes;
  const double scale = kPointsPerInch / options.dpi;
  const Surface page(cairo_pdf_surface_create_for_stream(append, &bytes, image.width * scale,
                                                         image.height * scale));
  require(cairo_surface_status(page.get()));
  {
    const Drawing drawing(cairo_create(page.get()));
    cairo_scale(drawing.get(), scale, scale);
    PdfPainter(drawing.get(), image, options, context).paint();
    cairo_show_page(drawing.get());
    require(cairo_status(drawing.get()));
  }
  cairo_surface_finish(page.get());
  require(cairo_surface_status(page.get()));
  return bytes;
}

}  // namespace quadrille
