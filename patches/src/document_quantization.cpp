#include "document_quantization.h"

#include <algorithm>

#include "document_rounding.h"
#include "document_shapes.h"
#include "quadrille/patch_geometry.h"

namespace quadrille {
namespace {

constexpr double kLargest = 1 << 24;

double channel_step(int channel) {
  // Inverse norms of the channels in RGB, see color_of(); alpha weighs as white does.
  static const std::array<double, kChannels> kSteps = {std::sqrt(1 / 3.0), std::sqrt(2.0),
                                                       std::sqrt(1.5), std::sqrt(1 / 3.0)};
  return kSteps[channel];
}

LocalColors local_colors(const Wedge& w, const ColorFrame& frame, const Eigen::Vector2d& moved) {
  const Eigen::Array4d dx = channels_of(w.dx), dy = channels_of(w.dy);
  LocalColors c;
  c[kValue] = channels_of(w.value) + dx * moved.x() + dy * moved.y();
  c[kAlongX] = dx * frame.root(0, 0) + dy * frame.root(0, 1);
  c[kAlongY] = dx * frame.root(1, 0) + dy * frame.root(1, 1);
  c[kTwist] = channels_of(w.twist) * frame.area;
  return c;
}

Wedge wedge_of(const WedgeCode& code, const ColorFrame& frame, double step, bool opaque) {
  std::array<Eigen::Array4d, 4> kinds;
  for (int kind = 0; kind < 4; ++kind) {
    for (int c = 0; c < kChannels; ++c) {
      kinds[kind][c] = code[c][kind] * color_step_of(c, static_cast<WedgeKind>(kind), step);
    }
  }
  if (opaque) kinds[kValue][kAlpha] = 1;
  const Eigen::Matrix2d& i = frame.inverse;
  Wedge w;
  w.value = color_of(kinds[kValue]);
  w.dx = color_of(kinds[kAlongX] * i(0, 0) + kinds[kAlongY] * i(0, 1));
  w.dy = color_of(kinds[kAlongX] * i(1, 0) + kinds[kAlongY] * i(1, 1));
  w.twist = color_of(kinds[kTwist] / frame.area);
  return w;
}

/// A corner of each wedge.
std::vector<int> first_corners(const std::vector<int>& wedge_of_corner, std::size_t wedge_count) {
  std::vector<int> corner(wedge_count, 0);
  for (std::size_t h = wedge_of_corner.size(); h-- > 0;) {
    corner[wedge_of_corner[h]] = static_cast<int>(h);
  }
  return corner;
}

}  // namespace

std::vector<ColorFrame> color_frames(const QuadMesh& mesh, double position_step) {
  std::vector<ColorFrame> frames(mesh.vertex_count());
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    double xx = 0, xy = 0, yy = 0, area = 0;
    const auto fan = mesh.fan(v);
    const auto add = [&](const Eigen::Vector2d& t, double weight) {
      xx += weight * t.x() * t.x();
      xy += weight * t.x() * t.y();
      yy += weight * t.y() * t.y();
      return std::sqrt(t.x() * t.x() + t.y() * t.y());
    };
    for (const int h : fan) {
      const Eigen::Vector2d p = mesh.vertices[v];
      // Inner edges are met from both sides.
      const double out = add(mesh.vertices[mesh.tip(h)] - p, mesh.twin(h) < 0 ? 1 : 0.5);
      const int back = QuadMesh::prev(h);
      const double in = add(mesh.vertices[mesh.origin(back)] - p, mesh.twin(back) < 0 ? 1 : 0.5);
      area += out * in;
    }
    const double n = mesh.valence(v), trace = (xx + yy) * 2 / n;
    // The slope along an edge direction that no edge has is known less well, but known.
    const double floor = trace / 64 + position_step * position_step;
    xx = xx * 2 / n + floor;
    yy = yy * 2 / n + floor;
    xy = xy * 2 / n;
    const double root = std::sqrt(xx * yy - xy * xy), scale = std::sqrt(xx + yy + 2 * root);
    ColorFrame& frame = frames[v];
    frame.root << (xx + root) / scale, xy / scale, xy / scale, (yy + root) / scale;
    const double det = root;
    frame.inverse << frame.root(1, 1) / det, -frame.root(0, 1) / det, -frame.root(1, 0) / det,
        frame.root(0, 0) / det;
    frame.area = area / static_cast<double>(fan.size()) + position_step * position_step;
  }
  return frames;
}

Eigen::Array4d channels_of(const Color& c) {
  const double r = c[0], g = c[1], b = c[2];
  return {(r + g + b) / 3, r - b, g - (r + b) / 2, c[3]};
}

Color color_of(const Eigen::Array4d& c) {
  const double between = c[0] - c[2] / 3;
  return {static_cast<float>(between + c[1] / 2), static_cast<float>(c[0] + c[2] * (2 / 3.0)),
          static_cast<float>(between - c[1] / 2), static_cast<float>(c[3])};
}

double color_step_of(int channel, WedgeKind kind, double step) {
  // Inverse norms of the Hermite basis: the blending functions of values have the mean square
  // 26/35 per axis, those of derivatives 2/105.
  constexpr std::array<double, 4> kKind = {1, 6.25, 6.25, 39};
  return step * channel_step(channel) * kKind[kind];
}

bool can_quantize(const PatchMesh& patches, const PositionGrid& grid, double color_step) {
  const auto fits = [](double x) { return std::abs(x) < kLargest; };  // false for NaN
  if (!grid.is_usable()) return false;
  for (const auto& v : patches.mesh.vertices) {
    if (!fits(v.x() / grid.step()) || !fits(v.y() / grid.step())) return false;
  }
  for (const auto& tangents : patches.edge_tangents) {
    for (const auto& t : tangents) {
      if (!fits(t.x() / grid.step()) || !fits(t.y() / grid.step())) return false;
    }
  }
  const std::vector<ColorFrame> frames = color_frames(patches.mesh, grid.step());
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    const LocalColors local = local_colors(patches.wedges[patches.wedge_of_corner[h]],
                                           frames[patches.mesh.origin(h)], {grid.step(), 0});
    for (int kind = 0; kind < 4; ++kind) {
      for (int c = 0; c < kChannels; ++c) {
        const double steps = color_step_of(c, static_cast<WedgeKind>(kind), color_step);
        if (!fits(local[kind][c] / steps)) return false;
      }
    }
  }
  return true;
}

QuantizedPatches quantize(const PatchMesh& patches, const PositionGrid& grid, double color_step) {
  QuantizedPatches out;
  out.mesh = patches.mesh;
  out.opaque = patches.opaque;
  out.points.resize(patches.mesh.vertices.size());
  for (std::size_t v = 0; v < out.points.size(); ++v) {
    for (int axis = 0; axis < 2; ++axis) {
      out.points[v][axis] = grid.nearest(axis, patches.mesh.vertices[v][axis]);
    }
    out.mesh.vertices[v] = grid.at(out.points[v]);
  }
  out.wedge_of_corner = patches.wedge_of_corner;
  out.wedges.resize(patches.wedges.size());
  quantize_tangents(patches, grid.step(), out);

  const PatchMesh moved = geometry_of(out);
  const std::vector<ColorFrame> frames = color_frames(moved.mesh, grid.step());
  const std::vector<int> corners = first_corners(patches.wedge_of_corner, patches.wedges.size());
  std::vector<LocalColors> exact;
  for (std::size_t w = 0; w < patches.wedges.size(); ++w) {
    const int v = out.mesh.origin(corners[w]);
    exact.push_back(local_colors(patches.wedges[w], frames[v],
                                 moved.mesh.vertices[v] - patches.mesh.vertices[v]));
    if (out.opaque) {
      for (Eigen::Array4d& kind : exact.back()) kind[kAlpha] = 0;
    }
  }
  out.wedges = round_colors(moved, frames, exact, color_step);
  return out;
}

PatchMesh geometry_of(const QuantizedPatches& quantized) {
  PatchMesh patches;
  patches.mesh = quantized.mesh;
  patches.edge_tangents = quantized.tangents;
  patches.wedge_of_corner = quantized.wedge_of_corner;
  patches.wedges.resize(quantized.wedges.size());
  patches.opaque = quantized.opaque;
  return patches;
}

PatchMesh dequantize(const QuantizedPatches& quantized, const PositionGrid& grid,
                     double color_step) {
  PatchMesh patches = geometry_of(quantized);
  const std::vector<ColorFrame> frames = color_frames(patches.mesh, grid.step());
  const std::vector<int> corners =
      first_corners(quantized.wedge_of_corner, quantized.wedges.size());
  for (std::size_t w = 0; w < quantized.wedges.size(); ++w) {
    patches.wedges[w] = wedge_of(quantized.wedges[w], frames[patches.mesh.origin(corners[w])],
                                 color_step, quantized.opaque);
  }
  return patches;
}

}  // namespace quadrille
