#include "cairo_mesh.h"

#include <stdexcept>
#include <vector>

namespace quadrille::bench {
namespace {

template <class T>
std::vector<BicubicBezier<T>> split(std::vector<BicubicBezier<T>> parts, int divisions) {
  for (int n = 1; n < divisions; n *= 2) {
    std::vector<BicubicBezier<T>> halves;
    for (const auto& part : parts) {
      for (const auto& side : part.split_u()) {
        for (const auto& quarter : side.split_v()) halves.push_back(quarter);
      }
    }
    parts = std::move(halves);
  }
  return parts;
}

void add_patch(cairo_pattern_t* mesh, const BicubicBezier<Eigen::Vector2d>& position,
               const BicubicBezier<Color>& color) {
  const auto& p = position.control;
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
  const Eigen::Vector2d inner[4] = {p[1][1], p[1][2], p[2][2], p[2][1]};
  const Color corners[4] = {color.control[0][0], color.control[0][3], color.control[3][3],
                            color.control[3][0]};
  for (int k = 0; k < 4; ++k) {
    cairo_mesh_pattern_set_control_point(mesh, k, inner[k].x(), inner[k].y());
    cairo_mesh_pattern_set_corner_color_rgb(mesh, k, corners[k][0], corners[k][1], corners[k][2]);
  }
  cairo_mesh_pattern_end_patch(mesh);
}

}  // namespace

CairoMesh::CairoMesh(const VectorImage& image, double scale, const PixelRegion& region,
                     int divisions)
    : pattern_(cairo_pattern_create_mesh()),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, region.width, region.height)) {
  const PatchMesh& patches = image.layers.front().patches;
  for (int q = 0; q < patches.patch_count(); ++q) {
    BezierPatch patch = bezier_patch(patches, q);
    for (auto& row : patch.position.control) {
      for (auto& p : row) p = p * scale - Eigen::Vector2d(region.x, region.y);
    }
    const auto positions = split<Eigen::Vector2d>({patch.position}, divisions);
    const auto colors = split<Color>({patch.color}, divisions);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      add_patch(pattern_.get(), positions[i], colors[i]);
    }
  }
  if (cairo_pattern_status(pattern_.get()) != CAIRO_STATUS_SUCCESS ||
      cairo_surface_status(surface_.get()) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error("Cairo cannot make the mesh or its surface");
  }
}

void CairoMesh::paint() {
  const std::unique_ptr<cairo_t, Destroyer<cairo_destroy>> drawing(cairo_create(surface_.get()));
  cairo_set_operator(drawing.get(), CAIRO_OPERATOR_SOURCE);
  cairo_set_source(drawing.get(), pattern_.get());
  cairo_paint(drawing.get());
  if (cairo_status(drawing.get()) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error("Cairo does not paint the mesh");
  }
}

}  // namespace quadrille::bench
