// Jakob, Tarini, Panozzo, Sorkine-Hornung, Instant field-aligned meshes, 2015, section 4; paper
// section 3.2, Eq. 9 and 10.
#include "quadrille/position_field.h"

#include <algorithm>
#include <cmath>

#include "lattice_shift.h"
#include "metric_field.h"
#include "option_checks.h"
#include "position_level.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

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

/// The outermost pixels hold on to the picture's sides, its corner pixels to the corners.
void add_border_constraints(PositionLevel& level, float width, float height) {
  const int w = level.width(), h = level.height();
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const bool side_x = x == 0 || x + 1 == w, side_y = y == 0 || y + 1 == h;
      if (!side_x && !side_y) continue;
      // A picture of one pixel in a direction holds on to the nearer side, the left or the top.
      const Eigen::Vector2f point(x == 0 ? 0 : width, y == 0 ? 0 : height);
      const Eigen::Vector2f normal = side_x ? Eigen::Vector2f(1, 0) : Eigen::Vector2f(0, 1);
      level.set_constraint(
          x, y, side_x && side_y ? Constraint::fixed(point) : Constraint::line(point, normal, 1));
    }
  }
}

PositionLevel finest_level(const FeatureTensor& features, const CrossField& field,
                           const ScaleField& scale, float feature_weight) {
  const int w = field.z.width, h = field.z.height;
  PositionLevel level(w, h, 1);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      level.set_cross(x, y, field.z(x, y), scale.along_x(x, y), scale.along_y(x, y));
      const Eigen::Vector2f gradient = features.gradient(x, y);
      if (!features.edges(x, y) || gradient.norm() <= 0) continue;
      const Eigen::Vector2f normal = gradient.normalized();
      const Eigen::Vector2f ridge =
          level.centre(x, y) + ridge_offset(features, x, y, normal) * normal;
      level.set_constraint(x, y,
                           Constraint::line(ridge, normal, feature_weight * features.weight(x, y)));
    }
  }
  for (const OutlinePixel& p : features.outline) {
    level.set_constraint(p.x, p.y, Constraint::line(p.point, p.normal, 1));
  }
  add_border_constraints(level, static_cast<float>(w), static_cast<float>(h));
  return level;
}

/// Crosses are averaged as their representations; lengths follow their axes as tensors do.
PositionLevel coarsen(const PositionLevel& fine, float pixel, float width, float height) {
  const int w = (fine.width() + 1) / 2, h = (fine.height() + 1) / 2;
  PositionLevel coarse(w, h, pixel);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      std::complex<float> z = 0;
      MetricTensor metric;
      int count = 0;
      Constraint strongest;
      for (int k = 0; k < 4; ++k) {
        const int fx = 2 * x + (k & 1), fy = 2 * y + (k >> 1);
        if (fx >= fine.width() || fy >= fine.height()) continue;
        z += fine.cross(fx, fy);
        metric.add(1,
                   MetricTensor({fine.length_x(fx, fy), fine.length_y(fx, fy)}, fine.axis(fx, fy)));
        ++count;
        const Constraint constraint = fine.constraint(fx, fy);
        if (constraint.weight() > strongest.weight()) strongest = constraint;
      }
      const float size = std::abs(z);
      z = size > 1e-6f ? z / size : std::complex<float>(1);
      const AxisPair sum = metric.along(std::polar(1.0f, 0.25f * std::arg(z)));
      coarse.set_cross(x, y, z, sum.x / count, sum.y / count);
      coarse.set_constraint(x, y, strongest);
    }
  }
  add_border_constraints(coarse, width, height);
  return coarse;
}

void start_from(const PositionLevel& coarse, PositionLevel& fine) {
  for (int y = 0; y < fine.height(); ++y) {
    for (int x = 0; x < fine.width(); ++x) {
      fine.set_origin(x, y,
                      fine.frame(x, y).nearest(coarse.origin(x / 2, y / 2), fine.centre(x, y)));
    }
  }
}

}  // namespace

void check_options(const PositionOptions& options) {
  if (options.sweeps < 0 || !(options.feature_weight >= 0 && options.feature_weight <= 1)) {
    throw Error(ErrorCode::invalid_argument,
                "the position field needs a number of sweeps and a feature weight from 0 to 1");
  }
}

PositionField position_field(const FeatureTensor& features, const CrossField& field,
                             const ScaleField& scale, const PositionOptions& options,
                             const RunContext& context) {
  check_options(options);
  const int width = field.z.width, height = field.z.height;
  std::vector<PositionLevel> levels;
  levels.push_back(
      finest_level(features, field, scale, static_cast<float>(options.feature_weight)));
  while (std::min(levels.back().width(), levels.back().height()) > 1) {
    levels.push_back(coarsen(levels.back(), std::ldexp(1.0f, static_cast<int>(levels.size())),
                             static_cast<float>(width), static_cast<float>(height)));
  }
  PositionLevel& coarsest = levels.back();
  for (int y = 0; y < coarsest.height(); ++y) {
    for (int x = 0; x < coarsest.width(); ++x) {
      coarsest.set_origin(x, y, coarsest.constraint(x, y).pulled(coarsest.centre(x, y)));
    }
  }
  for (int l = static_cast<int>(levels.size()) - 1; l >= 0; --l) {
    if (l + 1 < static_cast<int>(levels.size())) start_from(levels[l + 1], levels[l]);
    for (int s = 0; s < options.sweeps; ++s) levels[l].smooth(context);
    context.progress("position field", 1 - static_cast<double>(l) / levels.size());
  }
  PositionField positions{FieldGrid<Eigen::Vector2f>(width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) positions.origin(x, y) = levels.front().origin(x, y);
  }
  return positions;
}

Eigen::Vector2i lattice_shift(const CrossField& field, const ScaleField& scale,
                              const PositionField& positions, int xi, int yi, int xj, int yj) {
  const auto point = [&](int x, int y) {
    return LatticePoint{static_cast<float>(field.angle(x, y)),
                        {scale.along_x(x, y), scale.along_y(x, y)},
                        positions.origin(x, y)};
  };
  return shift_between(point(xi, yi), point(xj, yj));
}

}  // namespace quadrille
