#include "stage_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "quadrille/patch_geometry.h"
#include "quadrille/patch_mesh.h"

namespace quadrille::cli {
namespace {

using Eigen::Vector2d;

Vector2d to_source(const WorkingPicture& working, double x, double y) {
  return {x * working.scale_x, y * working.scale_y};
}

/// The value of the working pixel that holds a source position.
template <class T>
const T& value_at(const FieldGrid<T>& grid, const WorkingPicture& working, double x, double y) {
  return grid(std::clamp(static_cast<int>(x / working.scale_x), 0, grid.width - 1),
              std::clamp(static_cast<int>(y / working.scale_y), 0, grid.height - 1));
}

void draw_features(Canvas& canvas, const Quadrangulation& stages) {
  canvas.tint([&](double x, double y) -> Canvas::Tint {
    if (value_at(stages.features.edges, stages.working, x, y)) return {kDark, 0.9};
    const double weight = value_at(stages.features.weight, stages.working, x, y);
    return {kRed, 0.75 * std::clamp(weight, 0.0, 1.0)};
  });
}

void draw_singularities(Canvas& canvas, const Quadrangulation& stages) {
  for (const Singularity& s : singularities(stages.cross)) {
    canvas.mark(to_source(stages.working, s.x, s.y), s.quarter_index > 0 ? kRed : kBlue);
  }
}

/// Those that the field had before cancelling and has no more, nor close by: moved ones stay out.
void draw_removed_singularities(Canvas& canvas, const Quadrangulation& stages) {
  constexpr double kMoved = 8;  // working pixels
  const auto& phases = stages.cross.phases;
  const auto before = std::ranges::find(phases, "renormalised", &CrossFieldPhase::name);
  if (before == phases.end()) return;
  const std::vector<Singularity> left = singularities(stages.cross);
  for (const Singularity& s : before->singularities) {
    const bool stayed = std::ranges::any_of(left, [&](const Singularity& other) {
      return other.quarter_index == s.quarter_index &&
             std::hypot(other.x - s.x, other.y - s.y) <= kMoved;
    });
    if (stayed) continue;
    canvas.ring(to_source(stages.working, s.x, s.y), s.quarter_index > 0 ? kRed : kBlue);
  }
}

/// Working pixels between two drawn crosses: whole, so that no row or column is wider than others.
double whole_step(double wished) { return std::max(1.0, std::round(wished)); }

void draw_cross_field(Canvas& canvas, const Quadrangulation& stages) {
  constexpr double kSpacing = 20, kArm = 8;  // canvas pixels
  const CrossField& cross = stages.cross;
  const double step_x = whole_step(kSpacing / canvas.zoom() / stages.working.scale_x);
  const double step_y = whole_step(kSpacing / canvas.zoom() / stages.working.scale_y);
  for (double y = step_y / 2; y < cross.z.height; y += step_y) {
    for (double x = step_x / 2; x < cross.z.width; x += step_x) {
      const int i = static_cast<int>(x), j = static_cast<int>(y);
      const Vector2d centre = to_source(stages.working, i + 0.5, j + 0.5);
      for (const double turn : {0.0, std::numbers::pi / 2}) {
        const double angle = cross.angle(i, j) + turn;
        const Vector2d arm = Vector2d(std::cos(angle), std::sin(angle)) * (kArm / canvas.zoom());
        canvas.line(centre - arm, centre + arm, kDark);
      }
    }
  }
  draw_removed_singularities(canvas, stages);
  draw_singularities(canvas, stages);
}

/// From short (dark violet) over teal to long (yellow): even steps of lightness.
Ink length_ink(double t) {
  constexpr std::array<Ink, 5> kStops = {
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = std::clamp(t, 0.0, 1.0) * (kStops.size() - 1);
  const int low = std::min<int>(static_cast<int>(at), kStops.size() - 2);
  Ink ink;
  for (int c = 0; c < 3; ++c) {
    ink[c] = static_cast<int>(kStops[low][c] + (at - low) * (kStops[low + 1][c] - kStops[low][c]));
  }
  return ink;
}

/// Crosses with the lengths and directions of the lattice's edges, with room between them.
void draw_edge_lengths(Canvas& canvas, const Quadrangulation& stages) {
  constexpr double kSpacing = 64, kLongestArm = 28;  // canvas pixels
  const ScaleField& scale = stages.scale;
  const double longest =
      std::max(std::ranges::max(scale.along_x.data), std::ranges::max(scale.along_y.data));
  const double shrink =
      std::min(0.5, kLongestArm / canvas.zoom() / (longest * stages.working.scale_x));
  const double step_x = std::max(1.0, kSpacing / canvas.zoom() / stages.working.scale_x);
  const double step_y = std::max(1.0, kSpacing / canvas.zoom() / stages.working.scale_y);
  for (double y = step_y / 2; y < scale.along_x.height; y += step_y) {
    for (double x = step_x / 2; x < scale.along_x.width; x += step_x) {
      const int i = static_cast<int>(x), j = static_cast<int>(y);
      const double angle = stages.cross.angle(i, j);
      const Vector2d axis(std::cos(angle), std::sin(angle)), normal(-axis.y(), axis.x());
      const Vector2d place(i + 0.5, j + 0.5);
      for (const Vector2d& edge :
           {Vector2d(axis * scale.along_x(i, j)), Vector2d(normal * scale.along_y(i, j))}) {
        const Vector2d from = place - shrink * edge, to = place + shrink * edge;
        canvas.line(to_source(stages.working, from.x(), from.y()),
                    to_source(stages.working, to.x(), to.y()), kDark, 2);
      }
    }
  }
}

void draw_scale(Canvas& canvas, const Quadrangulation& stages) {
  FieldGrid<float> lengths = stages.scale.along_x;  // logarithms of the geometric means
  for (std::size_t i = 0; i < lengths.data.size(); ++i) {
    lengths.data[i] = 0.5f * std::log(lengths.data[i] * stages.scale.along_y.data[i]);
  }
  const auto [shortest, longest] = std::ranges::minmax_element(lengths.data);
  const double low = *shortest, range = *longest - low;
  canvas.tint([&](double x, double y) -> Canvas::Tint {
    const double length = value_at(lengths, stages.working, x, y);
    return {length_ink(range > 0 ? (length - low) / range : 0.5), 0.7};
  });
  draw_edge_lengths(canvas, stages);
}

void draw_positions(Canvas& canvas, const Quadrangulation& stages) {
  for (const Eigen::Vector2f& origin : stages.position.origin.data) {
    canvas.dot(to_source(stages.working, origin.x(), origin.y()), 1.2, kDark);
  }
  draw_singularities(canvas, stages);
}

void mark_irregular_vertices(Canvas& canvas, const QuadMesh& mesh) {
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.is_border_vertex(v) || mesh.valence(v) == 4) continue;
    canvas.mark(mesh.vertices[v], mesh.valence(v) < 4 ? kRed : kBlue);
  }
}

void draw_quads(Canvas& canvas, const Quadrangulation& stages) {
  const QuadMesh& mesh = stages.mesh;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    canvas.line(mesh.vertices[mesh.origin(h)], mesh.vertices[mesh.tip(h)], kDark);
  }
  mark_irregular_vertices(canvas, mesh);
}

void draw_patches(Canvas& canvas, const Quadrangulation& stages) {
  constexpr int kSegments = 12;
  PatchMesh patches = straight_patches(stages.mesh);
  set_bessel_tangents(patches);
  guard_folds(patches);
  const QuadMesh& mesh = patches.mesh;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    const auto& [start, end] = patches.edge_tangents[e];
    std::vector<Vector2d> points;
    for (int i = 0; i <= kSegments; ++i) {
      const auto basis = hermite_basis(static_cast<double>(i) / kSegments);
      points.push_back(basis[0] * mesh.vertices[mesh.origin(h)] + basis[1] * start +
                       basis[2] * mesh.vertices[mesh.tip(h)] + basis[3] * end);
    }
    canvas.curve(points, kDark);
  }
  mark_irregular_vertices(canvas, mesh);
}

}  // namespace

const std::vector<StagePicture>& stage_pictures() {
  static const std::vector<StagePicture> pictures = {
      {"feature", "feature weight in red, feature lines dark", true, draw_features},
      {"cross-field",
       "crosses; singularities red (+1/4) and blue (-1/4), rings where one was cancelled", true,
       draw_cross_field},
      {"scale",
       "edge length from violet (short) to yellow (long); crosses show both lengths and directions",
       true, draw_scale},
      {"position", "the lattice point of every working pixel", true, draw_positions},
      {"quads", "the mesh; vertices of valence 3 or less red, 5 or more blue", false, draw_quads},
      {"patches", "the curved edges of the patches", false, draw_patches},
  };
  return pictures;
}

}  // namespace quadrille::cli
