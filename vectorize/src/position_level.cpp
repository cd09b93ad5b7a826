#include "position_level.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "parallel.h"

namespace quadrille {
namespace {

constexpr int kRun = 64;  // pixels of one colour that are handled together
constexpr std::array<std::array<int, 2>, 8> kNeighbours = {
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

}  // namespace

PositionLevel::PositionLevel(int width, int height, float pixel)
    : width_(width),
      height_(height),
      pixel_(pixel),
      stride_((width + 1) / 2),
      plane_(stride_ * ((height + 1) / 2)),
      z_(4 * plane_) {
  for (auto* values : {&cos_, &sin_, &length_x_, &length_y_, &inverse_x_, &inverse_y_, &point_x_,
                       &point_y_, &pull_xx_, &pull_xy_, &pull_yy_, &origin_x_, &origin_y_}) {
    values->assign(4 * plane_, 0);
  }
}

void PositionLevel::set_cross(int x, int y, std::complex<float> z, float length_x, float length_y) {
  const std::size_t i = at(x, y);
  const float angle = 0.25f * std::arg(z);
  z_[i] = z;
  cos_[i] = std::cos(angle);
  sin_[i] = std::sin(angle);
  length_x_[i] = length_x;
  length_y_[i] = length_y;
  inverse_x_[i] = 1 / length_x;
  inverse_y_[i] = 1 / length_y;
}

LatticeFrame PositionLevel::frame(int x, int y) const {
  const std::size_t i = at(x, y);
  return LatticeFrame(Eigen::Vector2f(cos_[i], sin_[i]), length_x_[i], length_y_[i]);
}

void PositionLevel::set_constraint(int x, int y, const Constraint& constraint) {
  const std::size_t i = at(x, y);
  point_x_[i] = constraint.point.x();
  point_y_[i] = constraint.point.y();
  pull_xx_[i] = constraint.xx;
  pull_xy_[i] = constraint.xy;
  pull_yy_[i] = constraint.yy;
}

Constraint PositionLevel::constraint(int x, int y) const {
  const std::size_t i = at(x, y);
  return {{point_x_[i], point_y_[i]}, pull_xx_[i], pull_xy_[i], pull_yy_[i]};
}

void PositionLevel::set_origin(int x, int y, const Eigen::Vector2f& origin) {
  origin_x_[at(x, y)] = origin.x();
  origin_y_[at(x, y)] = origin.y();
}

/// From running means to new origins.
void PositionLevel::finish_run(std::size_t first, int first_x, int y, int count,
                               const float* mean_x, const float* mean_y) {
  const float centre_y = (y + 0.5f) * pixel_;
  for (int k = 0; k < count; ++k) {
    const std::size_t i = first + k;
    const float dx = (first_x + 2 * k + 0.5f) * pixel_ - mean_x[k], dy = centre_y - mean_y[k];
    const float u = round_to_whole((cos_[i] * dx + sin_[i] * dy) * inverse_x_[i]) * length_x_[i];
    const float v = round_to_whole((cos_[i] * dy - sin_[i] * dx) * inverse_y_[i]) * length_y_[i];
    const float px = mean_x[k] + cos_[i] * u - sin_[i] * v;
    const float py = mean_y[k] + sin_[i] * u + cos_[i] * v;
    const float ox = point_x_[i] - px, oy = point_y_[i] - py;
    origin_x_[i] = px + pull_xx_[i] * ox + pull_xy_[i] * oy;
    origin_y_[i] = py + pull_xy_[i] * ox + pull_yy_[i] * oy;
  }
}

/// The pixels (first_x + 2 k, y), none of which is on the border.
void PositionLevel::smooth_run(int first_x, int y, int count) {
  std::array<float, kRun> mean_x, mean_y;
  const std::size_t first = at(first_x, y);
  std::copy_n(origin_x_.begin() + first, count, mean_x.begin());
  std::copy_n(origin_y_.begin() + first, count, mean_y.begin());
  float total = 0;
  for (const auto& [step_x, step_y] : kNeighbours) {
    const std::size_t next = at(first_x + step_x, y + step_y);
    const float *c = cos_.data() + next, *s = sin_.data() + next;
    const float *lx = length_x_.data() + next, *ly = length_y_.data() + next;
    const float *ix = inverse_x_.data() + next, *iy = inverse_y_.data() + next;
    const float *ox = origin_x_.data() + next, *oy = origin_y_.data() + next;
    const float share = 1 / (total + 1);
    for (int k = 0; k < count; ++k) {
      const float dx = mean_x[k] - ox[k], dy = mean_y[k] - oy[k];
      const float u = round_to_whole((c[k] * dx + s[k] * dy) * ix[k]) * lx[k];
      const float v = round_to_whole((c[k] * dy - s[k] * dx) * iy[k]) * ly[k];
      mean_x[k] += (c[k] * u - s[k] * v - dx) * share;
      mean_y[k] += (s[k] * u + c[k] * v - dy) * share;
    }
    total += 1;
  }
  finish_run(first, first_x, y, count, mean_x.data(), mean_y.data());
}

/// Any pixel, with the neighbours it has.
void PositionLevel::smooth_one(int x, int y) {
  Eigen::Vector2f mean = origin(x, y);
  float total = 0;
  for (const auto& [step_x, step_y] : kNeighbours) {
    const int nx = x + step_x, ny = y + step_y;
    if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_) continue;
    mean += (frame(nx, ny).nearest(origin(nx, ny), mean) - mean) / (total + 1);
    total += 1;
  }
  finish_run(at(x, y), x, y, 1, &mean.x(), &mean.y());
}

void PositionLevel::smooth(const RunContext& context) {
  for (int colour = 0; colour < 4; ++colour) {
    const int first_x = colour & 1, first_y = colour >> 1;
    parallel_rows(context, (height_ - first_y + 1) / 2, width_, [&](int row) {
      const int y = 2 * row + first_y;
      int x = first_x;
      if (y == 0 || y + 1 == height_) {
        for (; x < width_; x += 2) smooth_one(x, y);
        return;
      }
      if (x == 0) smooth_one(x, y), x += 2;
      while (x + 1 < width_) {
        const int count = std::min(kRun, (width_ - x) / 2);
        smooth_run(x, y, count);
        x += 2 * count;
      }
      if (x < width_) smooth_one(x, y);
    });
  }
}

}  // namespace quadrille
