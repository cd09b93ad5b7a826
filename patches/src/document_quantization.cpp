#include "document_quantization.h"

#include <algorithm>

namespace quadrille {
namespace {

constexpr double kLargest = 1 << 24;

double channel_step(int channel) {
  // Inverse norms of the channels in RGB, see color_of(); alpha weighs as white does.
  static const std::array<double, kChannels> kSteps = {std::sqrt(1 / 3.0), std::sqrt(2.0),
                                                       std::sqrt(1.5), std::sqrt(1 / 3.0)};
  return kSteps[channel];
}

Wedge wedge_of(const WedgeCode& code, const ColorFrame& frame, const ColorSteps& steps, int w,
               bool opaque) {
  std::array<Eigen::Array4d, 4> kinds;
  for (int kind = 0; kind < 4; ++kind) {
    for (int c = 0; c < kChannels; ++c) {
      kinds[kind][c] = code[c][kind] * steps(w, c, static_cast<WedgeKind>(kind));
    }
  }
  if (opaque) kinds[kValue][kAlpha] = 1;
  const Eigen::Matrix2d& i = frame.inverse;
  return {color_of(kinds[kValue]), color_of(kinds[kAlongX] * i(0, 0) + kinds[kAlongY] * i(0, 1)),
          color_of(kinds[kAlongX] * i(1, 0) + kinds[kAlongY] * i(1, 1)),
          color_of(kinds[kTwist] / frame.area)};
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

LocalColors local_colors(const Wedge& w, const ColorFrame& frame, const Eigen::Vector2d& moved) {
  const Eigen::Array4d dx = channels_of(w.dx), dy = channels_of(w.dy);
  LocalColors c;
  c[kValue] = channels_of(w.value) + dx * moved.x() + dy * moved.y();
  c[kAlongX] = dx * frame.root(0, 0) + dy * frame.root(0, 1);
  c[kAlongY] = dx * frame.root(1, 0) + dy * frame.root(1, 1);
  c[kTwist] = channels_of(w.twist) * frame.area;
  return c;
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

ColorSteps::ColorSteps(const QuadMesh& mesh, const std::vector<int>& wedge_of_corner,
                       std::size_t wedge_count, double step)
    : scale_(wedge_count, 0) {
  set_step(step);
  constexpr double kLeastScale = 0.25, kMostScale = 4;
  double total = 0;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    const double area = std::abs(quad_area(mesh, q));
    for (int k = 0; k < 4; ++k) scale_[wedge_of_corner[4 * q + k]] += area;
    total += 4 * area;
  }
  if (!(total > 0)) {
    scale_.assign(wedge_count, 1);
    return;
  }
  const double mean = total / static_cast<double>(wedge_count);
  for (double& scale : scale_) scale = std::clamp(mean / scale, kLeastScale, kMostScale);
}

void ColorSteps::set_step(double step) {
  // Inverse norms of the Hermite basis: the blending functions of values have the mean square
  // 26/35 per axis, those of derivatives 2/105.
  constexpr std::array<double, 4> kKind = {1, 6.25, 6.25, 39};
  for (int c = 0; c < kChannels; ++c) {
    for (int kind = 0; kind < 4; ++kind) of_[c][kind] = step * channel_step(c) * kKind[kind];
  }
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
  const ColorSteps steps(patches.mesh, patches.wedge_of_corner, patches.wedges.size(), color_step);
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    const LocalColors local = local_colors(patches.wedges[patches.wedge_of_corner[h]],
                                           frames[patches.mesh.origin(h)], {grid.step(), 0});
    for (int kind = 0; kind < 4; ++kind) {
      for (int c = 0; c < kChannels; ++c) {
        const double step = steps(patches.wedge_of_corner[h], c, static_cast<WedgeKind>(kind));
        if (!fits(local[kind][c] / step)) return false;
      }
    }
  }
  return true;
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
  const ColorSteps steps(patches.mesh, patches.wedge_of_corner, patches.wedges.size(), color_step);
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    const int w = quantized.wedge_of_corner[h];
    patches.wedges[w] =
        wedge_of(quantized.wedges[w], frames[patches.mesh.origin(h)], steps, w, quantized.opaque);
  }
  return patches;
}

}  // namespace quadrille
