#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "lattice_frame.h"
#include "quadrille/field_grid.h"
#include "quadrille/run_context.h"

namespace quadrille {

/// Moves a lattice point p by matrix (point - p): along a normal onto a line, or along both axes.
struct Constraint {
  Eigen::Vector2f point = Eigen::Vector2f::Zero();
  float xx = 0, xy = 0, yy = 0;  ///< the symmetric matrix
  float weight() const { return xx + yy; }

  Eigen::Vector2f pulled(const Eigen::Vector2f& p) const {
    const Eigen::Vector2f d = point - p;
    return p + Eigen::Vector2f(xx * d.x() + xy * d.y(), xy * d.x() + yy * d.y());
  }

  static Constraint line(const Eigen::Vector2f& point, const Eigen::Vector2f& normal,
                         float weight) {
    return {point, weight * normal.x() * normal.x(), weight * normal.x() * normal.y(),
            weight * normal.y() * normal.y()};
  }
  static Constraint fixed(const Eigen::Vector2f& point) { return {point, 1, 0, 1}; }
};

/// One level of the hierarchy of position_field(). Lengths and positions are in finest working
/// pixels on every level. Every quantity is stored as four planes, one for each of the colours
/// (x & 1, y & 1) of the sweeps, so that a sweep runs through consecutive memory.
class PositionLevel {
 public:
  PositionLevel(int width, int height, float pixel);

  int width() const { return width_; }
  int height() const { return height_; }
  Eigen::Vector2f centre(int x, int y) const { return {(x + 0.5f) * pixel_, (y + 0.5f) * pixel_}; }

  void set_cross(int x, int y, std::complex<float> z, float length_x, float length_y);
  std::complex<float> cross(int x, int y) const { return z_[at(x, y)]; }
  std::complex<float> axis(int x, int y) const { return {cos_[at(x, y)], sin_[at(x, y)]}; }
  float length_x(int x, int y) const { return length_x_[at(x, y)]; }
  float length_y(int x, int y) const { return length_y_[at(x, y)]; }
  LatticeFrame frame(int x, int y) const;

  void set_constraint(int x, int y, const Constraint& constraint);
  Constraint constraint(int x, int y) const;

  void set_origin(int x, int y, const Eigen::Vector2f& origin);
  Eigen::Vector2f origin(int x, int y) const { return {origin_x_[at(x, y)], origin_y_[at(x, y)]}; }

  /// One Gauss-Seidel sweep in four colours, no two of which are neighbours in the
  /// 8-neighbourhood: each point becomes the running mean of its neighbours' lattice points next to
  /// it, then the lattice point nearest to its pixel, then follows its constraint.
  void smooth(const RunContext& context);

 private:
  int width_, height_;
  float pixel_;
  std::size_t stride_, plane_;
  std::vector<std::complex<float>> z_;
  std::vector<float> cos_, sin_, length_x_, length_y_, inverse_x_, inverse_y_;
  std::vector<float> point_x_, point_y_, pull_xx_, pull_xy_, pull_yy_;
  std::vector<float> origin_x_, origin_y_;

  std::size_t at(int x, int y) const {
    return (((y & 1) << 1) | (x & 1)) * plane_ + (y >> 1) * stride_ + (x >> 1);
  }
  void smooth_one(int x, int y);
  void smooth_run(int first_x, int y, int count);
  void finish_run(std::size_t first, int first_x, int y, int count, const float* mean_x,
                  const float* mean_y);
};

}  // namespace quadrille
