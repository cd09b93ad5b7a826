#include "quadrille/feature_snapping.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "corner_sines.h"
#include "option_checks.h"
#include "parallel.h"
#include "premultiplied_colours.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using Colours = PremultipliedColours;
using Colour = Colours::Colour;
using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kReach = 0.5;         // of a cell's width, on either side of an edge
constexpr double kSampleSpacing = 3;   // pixels along an edge
constexpr int kMaxSamples = 16;        // along an edge
constexpr int kStepsPerSide = 8;       // across an edge
constexpr double kFinestStep = 0.5;    // pixels across an edge
constexpr double kNoise = 0.06;        // contrasts below it carry little weight, sRGB units
constexpr double kStiffness = 0.3;     // pull toward staying, beside a full-contrast edge's 1
constexpr double kEvenness = 0.1;      // pull toward the mean of the neighbours
constexpr double kLongestStep = 0.35;  // of the shortest edge at a vertex
constexpr int kItemCost = 64;          // of a quad or an edge, in the pixels of parallel_rows
constexpr double kLongCell = 3;        // cells count as at most this many edge lengths wide

/// The part of row `y` that lies in a convex quad.
std::array<double, 2> row_span(const std::array<Vector2d, 4>& corners, double y) {
  double left = 1e300, right = -1e300;
  for (int k = 0; k < 4; ++k) {
    const Vector2d &a = corners[k], &b = corners[(k + 1) & 3];
    if ((a.y() <= y) == (b.y() <= y)) continue;
    const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    left = std::min(left, x);
    right = std::max(right, x);
  }
  return {left, right};
}

Colour mean_colour(const QuadMesh& mesh, int q, const Colours& colours) {
  std::array<Vector2d, 4> corners;
  double top = 1e300, bottom = -1e300;
  for (int k = 0; k < 4; ++k) {
    corners[k] = mesh.vertices[mesh.quads()[q][k]];
    top = std::min(top, corners[k].y());
    bottom = std::max(bottom, corners[k].y());
  }
  Colour sum = Colour::Zero();
  int count = 0;
  const int first = std::max(0, static_cast<int>(std::ceil(top - 0.5)));
  const int last = std::min(colours.height() - 1, static_cast<int>(std::floor(bottom - 0.5)));
  for (int y = first; y <= last; ++y) {
    const auto [left, right] = row_span(corners, y + 0.5);
    if (left > right) continue;
    const int begin = std::max(0, static_cast<int>(std::ceil(left - 0.5)));
    const int end = std::min(colours.width() - 1, static_cast<int>(std::floor(right - 0.5)));
    for (int x = begin; x <= end; ++x) sum += colours.pixel(x, y);
    count += std::max(0, end - begin + 1);
  }
  if (count > 0) return sum / static_cast<float>(count);
  return colours.at(0.25 * (corners[0] + corners[1] + corners[2] + corners[3]));
}

/// What an edge asks of its two ends: normal equations of least squares.
struct Pull {
  Matrix2d matrix[2] = {Matrix2d::Zero(), Matrix2d::Zero()};
  Vector2d wish[2] = {Vector2d::Zero(), Vector2d::Zero()};
};

/// The way from an edge into one of its quads.
struct Probe {
  Vector2d start, direction;
  double reach, step;
};

/// How far from the start one colour ends and the other begins, and what that saves over no move.
struct Split {
  double distance = 0, cost = 0;
};

/// The cheapest one between the colour `near` at the start and `far`.
Split cheapest_split(const Colours& colours, const Probe& probe, const Colour& near,
                     const Colour& far) {
  Split best;
  double total = 0;
  for (double s = 0.5 * probe.step; s < probe.reach; s += probe.step) {
    const Colour here = colours.at(probe.start + s * probe.direction);
    total += ((here - far).squaredNorm() - (here - near).squaredNorm()) * probe.step;
    if (total < best.cost) best = {s + 0.5 * probe.step, total};
  }
  return best;
}

Pull edge_pull(const QuadMesh& mesh, int e, const std::vector<Colour>& means,
               const Colours& colours) {
  Pull pull;
  const int h = mesh.halfedge(e), twin = mesh.twin(h);
  if (twin < 0) return pull;
  const Vector2d start = mesh.vertices[mesh.origin(h)];
  const Vector2d along = mesh.vertices[mesh.tip(h)] - start;
  const double length = along.norm();
  if (!(length > 0)) return pull;
  const Vector2d normal(-along.y() / length, along.x() / length);  // into the quad of h
  const int inner = QuadMesh::quad_of(h), outer = QuadMesh::quad_of(twin);
  const double contrast2 = (means[inner] - means[outer]).squaredNorm();
  const double weight = contrast2 / (contrast2 + kNoise * kNoise);
  const double width_in = std::min(quad_area(mesh, inner) / length, kLongCell * length);
  const double width_out = std::min(quad_area(mesh, outer) / length, kLongCell * length);
  const double step = std::max(kFinestStep, kReach * std::max(width_in, width_out) / kStepsPerSide);
  const int samples =
      std::clamp(static_cast<int>(std::ceil(length / kSampleSpacing)), 2, kMaxSamples);
  const double sample_weight = weight * 2 * length / (samples * (width_in + width_out));
  for (int k = 0; k < samples; ++k) {
    const double t = (k + 0.5) / samples;
    const Vector2d place = start + t * along;
    // Moving into the inner quad gives its pixels to the outer one.
    const Split in = cheapest_split(colours, {place, normal, kReach * width_in, step}, means[inner],
                                    means[outer]);
    const Split out = cheapest_split(colours, {place, -normal, kReach * width_out, step},
                                     means[outer], means[inner]);
    const double cost = std::min(in.cost, out.cost);
    double offset = out.cost < in.cost ? -out.distance : in.distance;
    // A clear step saves its whole contrast per pixel; what saves less, noise or a ramp, pulls
    // less.
    if (offset != 0) offset *= std::min(1.0, -cost / (contrast2 * std::abs(offset)));
    for (int end = 0; end < 2; ++end) {
      const double share = sample_weight * (end == 0 ? 1 - t : t);
      pull.matrix[end] += share * normal * normal.transpose();
      pull.wish[end] += share * offset * normal;
    }
  }
  return pull;
}

bool is_on_feature(const QuadMesh& mesh, int v) {
  return std::any_of(mesh.fan(v).begin(), mesh.fan(v).end(), [&](int h) {
    return ((mesh.edge_flags[mesh.edge(h)] | mesh.edge_flags[mesh.edge(QuadMesh::prev(h))]) &
            kFeatureEdge) != 0;
  });
}

/// What a vertex may do: nothing on a feature edge, slide along an axis or nothing on the border.
Vector2d allowed(const QuadMesh& mesh, int v, const Vector2d& step) {
  if (is_on_feature(mesh, v)) return Vector2d::Zero();
  if (!mesh.is_border_vertex(v)) return step;
  const int out = mesh.fan(v).front(), in = QuadMesh::prev(mesh.fan(v).back());
  const Vector2d &before = mesh.vertices[mesh.origin(in)], &here = mesh.vertices[v],
                 &after = mesh.vertices[mesh.tip(out)];
  Vector2d slide = Vector2d::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    if (before[1 - axis] == here[1 - axis] && here[1 - axis] == after[1 - axis]) {
      slide[axis] = step[axis];
    }
  }
  return slide;
}

void move_vertex(QuadMesh& mesh, int v, const Matrix2d& matrix, const Vector2d& wish,
                 double min_sine) {
  const Vector2d here = mesh.vertices[v];
  Vector2d even = Vector2d::Zero();
  double shortest = 1e300;
  const auto meet = [&](int neighbour) {
    const Vector2d edge = mesh.vertices[neighbour] - here;
    even += edge / mesh.valence(v);
    shortest = std::min(shortest, edge.norm());
  };
  for (const int h : mesh.fan(v)) meet(mesh.tip(h));
  if (mesh.is_border_vertex(v)) meet(mesh.origin(QuadMesh::prev(mesh.fan(v).back())));
  const Matrix2d stiff = matrix + kStiffness * Matrix2d::Identity();
  Vector2d step = allowed(mesh, v, stiff.inverse() * (wish + kEvenness * even));
  const double length = step.norm(), most = kLongestStep * shortest;
  if (!(length > 0)) return;
  if (length > most) step *= most / length;
  const double acceptable = std::min(min_sine, smallest_sine_around(mesh, v));
  for (const double share : {1.0, 0.5, 0.25}) {
    mesh.vertices[v] = here + share * step;
    if (smallest_sine_around(mesh, v) >= acceptable) return;
  }
  mesh.vertices[v] = here;
}

}  // namespace

void check_options(const SnapOptions& options) {
  if (options.rounds < 0 || !(options.min_corner_sine > 0 && options.min_corner_sine < 1)) {
    throw Error(ErrorCode::invalid_argument,
                "snapping needs a number of rounds and a corner sine between 0 and 1");
  }
}

void snap_to_features(QuadMesh& mesh, const Raster& picture, const SnapOptions& options,
                      const RunContext& context) {
  check_raster(picture);
  check_options(options);
  const Colours colours(picture);
  std::vector<Colour> means(mesh.quad_count());
  std::vector<Pull> pulls(mesh.edge_count());
  for (int round = 0; round < options.rounds; ++round) {
    context.progress("snapping", static_cast<double>(round) / options.rounds);
    parallel_rows(context, mesh.quad_count(), kItemCost,
                  [&](int q) { means[q] = mean_colour(mesh, q, colours); });
    parallel_rows(context, mesh.edge_count(), kItemCost,
                  [&](int e) { pulls[e] = edge_pull(mesh, e, means, colours); });
    std::vector<Matrix2d> matrix(mesh.vertex_count(), Matrix2d::Zero());
    std::vector<Vector2d> wish(mesh.vertex_count(), Vector2d::Zero());
    context.progress("snapping", (round + 0.7) / options.rounds);
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const int h = mesh.halfedge(e);
      const int ends[2] = {mesh.origin(h), mesh.tip(h)};
      for (int end = 0; end < 2; ++end) {
        matrix[ends[end]] += pulls[e].matrix[end];
        wish[ends[end]] += pulls[e].wish[end];
      }
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      move_vertex(mesh, v, matrix[v], wish[v], options.min_corner_sine);
    }
  }
}

}  // namespace quadrille
