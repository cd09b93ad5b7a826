// Jakob, Tarini, Panozzo, Sorkine-Hornung, Instant field-aligned meshes, 2015, section 4; paper
// section 3.2, Eq. 9 and 10.
#include "quadrille/position_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lattice_frame.h"
#include "parallel.h"

namespace quadrille {
namespace {

constexpr float kQuarterTurn = std::numbers::pi_v<float> / 2;

/// Pulls a lattice point along `normal` onto the line through `point`; corners fix both axes.
struct Constraint {
  Eigen::Vector2f point = Eigen::Vector2f::Zero();
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();
  float weight = 0;
  bool both_axes = false;

  Eigen::Vector2f pulled(const Eigen::Vector2f& p) const {
    const Eigen::Vector2f offset = point - p;
    if (both_axes) return p + weight * offset;
    return p + weight * normal.dot(offset) * normal;
  }
};

/// One level of the hierarchy; lengths and positions are in finest working pixels on every level.
struct Level {
  float pixel = 1;  // side of this level's pixels
  FieldGrid<std::complex<float>> z;
  FieldGrid<float> length_x, length_y;
  FieldGrid<Constraint> constraint;
  FieldGrid<Eigen::Vector2f> origin;
  FieldGrid<LatticeFrame> frame;

  Eigen::Vector2f centre(int x, int y) const { return {(x + 0.5f) * pixel, (y + 0.5f) * pixel}; }
};

/// Distance from an edge pixel's centre to the ridge of the gradient along the normal, by the
/// parabola through three samples; at most half a pixel.
float ridge_offset(const FeatureTensor& features, int x, int y, const Eigen::Vector2f& normal) {
  const auto strength = [&](float s) {
    const int i =
        std::clamp(static_cast<int>(std::lround(x + s * normal.x())), 0, features.weight.width - 1);
    const int j = std::clamp(static_cast<int>(std::lround(y + s * normal.y())), 0,
                             features.weight.height - 1);
    return features.gradient(i, j).norm();
  };
  const float before = strength(-1), here = strength(0), after = strength(1);
  const float curvature = before - 2 * here + after;
  if (curvature >= 0) return 0;
  return std::clamp(0.5f * (before - after) / curvature, -0.5f, 0.5f);
}

FieldGrid<Constraint> finest_constraints(const FeatureTensor& features, float feature_weight) {
  const int w = features.weight.width, h = features.weight.height;
  FieldGrid<Constraint> constraints(w, h);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const Eigen::Vector2f gradient = features.gradient(x, y);
      if (!features.edges(x, y) || gradient.norm() <= 0) continue;
      const Eigen::Vector2f normal = gradient.normalized();
      const Eigen::Vector2f centre(x + 0.5f, y + 0.5f);
      constraints(x, y) = {centre + ridge_offset(features, x, y, normal) * normal, normal,
                           feature_weight * features.weight(x, y), false};
    }
  }
  for (const OutlinePixel& p : features.outline) {
    constraints(p.x, p.y) = {p.point, p.normal, 1, false};
  }
  return constraints;
}

/// The outermost pixels hold on to the picture's sides, its corner pixels to the corners.
void add_border_constraints(Level& level, float width, float height) {
  const int w = level.z.width, h = level.z.height;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const bool side_x = x == 0 || x + 1 == w, side_y = y == 0 || y + 1 == h;
      if (!side_x && !side_y) continue;
      // A picture of one pixel in a direction holds on to the nearer side, the left or the top.
      const Eigen::Vector2f point(x == 0 ? 0 : width, y == 0 ? 0 : height);
      const Eigen::Vector2f normal = side_x ? Eigen::Vector2f(1, 0) : Eigen::Vector2f(0, 1);
      level.constraint(x, y) = {point, normal, 1, side_x && side_y};
    }
  }
}

void set_frames(Level& level) {
  level.frame = FieldGrid<LatticeFrame>(level.z.width, level.z.height);
  for (std::size_t i = 0; i < level.z.data.size(); ++i) {
    level.frame.data[i] = LatticeFrame(0.25f * std::arg(level.z.data[i]), level.length_x.data[i],
                                       level.length_y.data[i]);
  }
}

Level coarsen(const Level& fine) {
  const int w = (fine.z.width + 1) / 2, h = (fine.z.height + 1) / 2;
  Level coarse{fine.pixel * 2,
               FieldGrid<std::complex<float>>(w, h),
               FieldGrid<float>(w, h),
               FieldGrid<float>(w, h),
               FieldGrid<Constraint>(w, h),
               {},
               {}};
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      std::complex<float> z = 0;
      float reciprocal_x = 0, reciprocal_y = 0;
      int count = 0;
      Constraint strongest;
      for (int k = 0; k < 4; ++k) {
        const int fx = 2 * x + (k & 1), fy = 2 * y + (k >> 1);
        if (fx >= fine.z.width || fy >= fine.z.height) continue;
        z += fine.z(fx, fy);
        reciprocal_x += 1 / fine.length_x(fx, fy);
        reciprocal_y += 1 / fine.length_y(fx, fy);
        ++count;
        if (fine.constraint(fx, fy).weight > strongest.weight) strongest = fine.constraint(fx, fy);
      }
      coarse.z(x, y) = std::abs(z) > 1e-6f ? z / std::abs(z) : std::complex<float>(1);
      coarse.length_x(x, y) = count / reciprocal_x;
      coarse.length_y(x, y) = count / reciprocal_y;
      coarse.constraint(x, y) = strongest;
    }
  }
  return coarse;
}

/// One Gauss-Seidel sweep in four colours, no two of which are neighbours in the 8-neighbourhood.
void smooth(Level& level, const RunContext& context) {
  const int w = level.z.width, h = level.z.height;
  for (int colour = 0; colour < 4; ++colour) {
    const int first_x = colour & 1, first_y = colour >> 1;
    parallel_rows(context, (h - first_y + 1) / 2, w, [&](int row) {
      const int y = 2 * row + first_y;
      for (int x = first_x; x < w; x += 2) {
        Eigen::Vector2f mean = level.origin(x, y);
        float total = 0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const int nx = x + dx, ny = y + dy;
            if ((dx == 0 && dy == 0) || nx < 0 || ny < 0 || nx >= w || ny >= h) continue;
            const Eigen::Vector2f rounded = level.frame(nx, ny).nearest(level.origin(nx, ny), mean);
            mean = (mean * total + rounded) / (total + 1);
            total += 1;
          }
        }
        const LatticeFrame& frame = level.frame(x, y);
        mean = frame.nearest(mean, level.centre(x, y));
        level.origin(x, y) = level.constraint(x, y).pulled(mean);
      }
    });
  }
}

void start_from(const Level& coarse, Level& fine) {
  fine.origin = FieldGrid<Eigen::Vector2f>(fine.z.width, fine.z.height, Eigen::Vector2f::Zero());
  for (int y = 0; y < fine.z.height; ++y) {
    for (int x = 0; x < fine.z.width; ++x) {
      fine.origin(x, y) = fine.frame(x, y).nearest(coarse.origin(x / 2, y / 2), fine.centre(x, y));
    }
  }
}

}  // namespace

PositionField position_field(const FeatureTensor& features, const CrossField& field,
                             const ScaleField& scale, const PositionOptions& options,
                             const RunContext& context) {
  const int width = field.z.width, height = field.z.height;
  std::vector<Level> levels;
  levels.push_back({1,
                    field.z,
                    scale.along_x,
                    scale.along_y,
                    finest_constraints(features, static_cast<float>(options.feature_weight)),
                    {},
                    {}});
  while (std::min(levels.back().z.width, levels.back().z.height) > 1) {
    levels.push_back(coarsen(levels.back()));
  }
  for (Level& level : levels) {
    add_border_constraints(level, static_cast<float>(width), static_cast<float>(height));
    set_frames(level);
  }
  Level& coarsest = levels.back();
  coarsest.origin = FieldGrid<Eigen::Vector2f>(coarsest.z.width, coarsest.z.height);
  for (int y = 0; y < coarsest.z.height; ++y) {
    for (int x = 0; x < coarsest.z.width; ++x) {
      coarsest.origin(x, y) = coarsest.constraint(x, y).pulled(coarsest.centre(x, y));
    }
  }
  for (int l = static_cast<int>(levels.size()) - 1; l >= 0; --l) {
    if (l + 1 < static_cast<int>(levels.size())) start_from(levels[l + 1], levels[l]);
    for (int s = 0; s < options.sweeps; ++s) smooth(levels[l], context);
    context.progress("position field", 1 - static_cast<double>(l) / levels.size());
  }
  return {std::move(levels.front().origin)};
}

Eigen::Vector2i lattice_shift(const CrossField& field, const ScaleField& scale,
                              const PositionField& positions, int xi, int yi, int xj, int yj) {
  const std::complex<float> zi = field.z(xi, yi), zj = field.z(xj, yj);
  const float angle_i = 0.25f * std::arg(zi), angle_j = 0.25f * std::arg(zj);
  // Seen from i, the axes of j keep their names or, an odd number of quarters on, swap.
  const float turn = 0.25f * std::arg(zj * std::conj(zi));
  const long quarters = std::lround((angle_j - angle_i - turn) / kQuarterTurn);
  const bool swapped = quarters % 2 != 0;
  const float jx = swapped ? scale.along_y(xj, yj) : scale.along_x(xj, yj);
  const float jy = swapped ? scale.along_x(xj, yj) : scale.along_y(xj, yj);
  const LatticeFrame frame(angle_i + 0.5f * turn, 0.5f * (scale.along_x(xi, yi) + jx),
                           0.5f * (scale.along_y(xi, yi) + jy));
  const Eigen::Vector2f shift =
      frame.to_lattice(positions.origin(xj, yj) - positions.origin(xi, yi));
  return {static_cast<int>(std::lround(shift.x())), static_cast<int>(std::lround(shift.y()))};
}

}  // namespace quadrille
