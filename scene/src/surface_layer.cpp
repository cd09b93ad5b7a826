#include <algorithm>
#include <limits>
#include <utility>

#include "layer_parts.h"
#include "quadrille/error.h"
#include "quadrille/mesh_region.h"
#include "quadrille/picture_layers.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr int kMostDivisions = 64;
constexpr int kProgressStep = 4096;  // patches between two reports

class Surface {
 public:
  Surface(const VectorImage& image, int divisions)
      : n_(divisions),
        stacked_(image.layers.size() > 1),
        opaque_(std::ranges::all_of(image.layers,
                                    [](const Layer& layer) { return layer.patches.opaque; })) {
    shapes_.cell = SceneShapes::Cell::polygon;
    const std::size_t cells = static_cast<std::size_t>(image.patch_count()) * n_ * n_;
    if (cells > std::numeric_limits<int>::max() / 8) {
      throw Error(ErrorCode::limit_exceeded,
                  "a surface of " + std::to_string(cells) +
                      " quads is too large; ask for fewer divisions of each patch");
    }
    shapes_.cell_points.reserve(4 * cells);
    shapes_.cell_begin.reserve(cells + 1);
  }

  void start(const Layer& layer, int index) {
    layer_ = &layer;
    layer_index_ = index;
    mirrored_ = layer.transform.linear().determinant() < 0;
    region_ = smooth_regions(layer.patches.mesh);
    corner_.assign(layer.patches.wedges.size(), -1);
    side_.assign(layer.patches.mesh.halfedge_count(), -1);
  }

  void add_patch(int q) {
    const FergusonPatch patch = ferguson_patch(layer_->patches, q);
    ids_.assign((n_ + 1) * (n_ + 1), -1);
    for (int k = 0; k < 4; ++k) {
      add_corner(patch, q, k);
      add_side(patch, q, k);
    }
    for (int j = 1; j < n_; ++j) {
      for (int i = 1; i < n_; ++i) {
        id(i, j) = add_point(patch.position.at(parameter(i), parameter(j)), patch, i, j);
      }
    }
    for (int j = 0; j < n_; ++j) {
      for (int i = 0; i < n_; ++i) add_cell(i, j);
    }
    patch_.insert(patch_.end(), n_ * n_, q);
    layers_.insert(layers_.end(), n_ * n_, layer_index_);
    regions_.insert(regions_.end(), n_ * n_, region_[q]);
  }

  SceneShapes finish() {
    using Kind = SceneArray::Kind;
    shapes_.point_arrays = {
        scene_array("rgba", "straight sRGB bytes as shown", std::move(rgba_), 4, Kind::color),
        opaque_ ? scene_array("color", "sRGB-encoded, unclamped", std::move(color_), 3, Kind::color)
                : scene_array("color_premultiplied", "sRGB-encoded times alpha, unclamped",
                              std::move(color_), 4, Kind::color)};
    shapes_.cell_arrays = {
        scene_array("patch", "number of the patch in its layer", std::move(patch_)),
        scene_array("layer", "layer of the picture, from 0", std::move(layers_)),
        scene_array("region", "smooth region that tears and the border bound",
                    std::move(regions_))};
    return std::move(shapes_);
  }

 private:
  double parameter(int i) const { return static_cast<double>(i) / n_; }
  int& id(int i, int j) { return ids_[j * (n_ + 1) + i]; }
  /// The point `step` divisions along side k of a patch, as column and row.
  std::array<int, 2> on_side(int k, int step) const {
    constexpr int kColumn[4] = {0, 1, 1, 0}, kRow[4] = {0, 0, 1, 1};
    const int to = (k + 1) % 4;
    return {kColumn[k] * (n_ - step) + kColumn[to] * step, kRow[k] * (n_ - step) + kRow[to] * step};
  }

  int add_point(const Vector2d& position, const FergusonPatch& patch, int i, int j) {
    shapes_.points.push_back(layer_->transform * position);
    if (stacked_) shapes_.heights.push_back(static_cast<float>(layer_index_));
    const Color c = patch.color.at(parameter(i), parameter(j));
    color_.insert(color_.end(), c.data(), c.data() + (opaque_ ? 3 : 4));
    const float alpha = opaque_ ? 1 : std::clamp(c[3], 0.0f, 1.0f);
    for (int channel = 0; channel < 3; ++channel) {
      const float straight = alpha > 0 ? std::clamp(c[channel] / alpha, 0.0f, 1.0f) : 0;
      rgba_.push_back(static_cast<std::uint8_t>(255 * straight + 0.5f));
    }
    rgba_.push_back(static_cast<std::uint8_t>(255 * alpha + 0.5f));
    return static_cast<int>(shapes_.points.size()) - 1;
  }

  void add_corner(const FergusonPatch& patch, int q, int k) {
    int& corner = corner_[layer_->patches.wedge_of_corner[4 * q + k]];
    const auto [i, j] = on_side(k, 0);
    if (corner < 0) corner = add_point(patch.position.value[k], patch, i, j);
    id(i, j) = corner;
  }

  /// The points inside side k, numbered along the direction of the edge.
  void add_side(const FergusonPatch& patch, int q, int k) {
    const PatchMesh& patches = layer_->patches;
    const int h = 4 * q + k, e = patches.mesh.edge(h), twin = patches.mesh.twin(h);
    const bool along = patches.mesh.halfedge(e) == h;
    const auto wedge = [&](int corner) { return patches.wedge_of_corner[corner]; };
    if (twin >= 0 && side_[twin] >= 0 && wedge(h) == wedge(QuadMesh::next(twin)) &&
        wedge(QuadMesh::next(h)) == wedge(twin)) {
      side_[h] = side_[twin];
    }
    const bool is_new = side_[h] < 0;
    if (is_new) side_[h] = static_cast<int>(shapes_.points.size());
    for (int step = 1; step < n_; ++step) {
      const auto [i, j] = on_side(k, along ? step : n_ - step);
      if (is_new) add_point(edge_point(patches, e, parameter(step)), patch, i, j);
      id(i, j) = side_[h] + step - 1;
    }
  }

  void add_cell(int i, int j) {
    int corners[4] = {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)};
    if (mirrored_) std::swap(corners[1], corners[3]);
    shapes_.cell_points.insert(shapes_.cell_points.end(), corners, corners + 4);
    shapes_.end_cell();
  }

  const int n_;
  const bool stacked_, opaque_;
  const Layer* layer_ = nullptr;
  int layer_index_ = 0;
  bool mirrored_ = false;
  std::vector<int> region_;  // per quad
  std::vector<int> corner_;  // per wedge: its point
  std::vector<int> side_;    // per half-edge: the first point inside
  std::vector<int> ids_;     // of the current patch
  SceneShapes shapes_;
  std::vector<float> color_;
  std::vector<std::uint8_t> rgba_;
  std::vector<std::int32_t> patch_, layers_, regions_;
};

}  // namespace

SceneLayer surface_layer(const VectorImage& image, int divisions, const RunContext& context) {
  if (divisions < 1 || divisions > kMostDivisions) {
    throw Error(ErrorCode::invalid_argument, "a surface cannot have " + std::to_string(divisions) +
                                                 " divisions per patch side; use 1 to 64");
  }
  Surface surface(image, divisions);
  const double all = std::max(image.patch_count(), 1);
  int done = 0;
  for (std::size_t l = 0; l < image.layers.size(); ++l) {
    surface.start(image.layers[l], static_cast<int>(l));
    for (int q = 0; q < image.layers[l].patches.patch_count(); ++q, ++done) {
      if (done % kProgressStep == 0) context.progress("surface", done / all);
      surface.add_patch(q);
    }
  }
  SceneLayer layer{"surface", "the patches as small quads with their colours"};
  layer.style.colors = "rgba";
  layer.content = surface.finish();
  return layer;
}

}  // namespace quadrille
