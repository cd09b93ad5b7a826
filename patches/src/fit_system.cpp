#include "fit_system.h"

#include <Eigen/Dense>
#include <algorithm>

#include "parallel_ranges.h"
#include "patch_scan.h"
#include "picture_sampling.h"

namespace quadrille {
namespace {

/// Damping of what a mixture leaves open, beside that of every square pixel: else slivers between
/// tears would take any colour to explain their pixels.
constexpr double kOpenWeight = 300;
constexpr double kBlockFloor = 1e-5;  // relative to a unit diagonal

/// Sums over the samples of one patch.
struct PatchSums {
  std::array<double, 49> moments;
  std::array<std::array<Eigen::Array4d, 4>, 4> residual;  ///< weighted by each Bernstein product

  explicit PatchSums(const std::array<double, 49>& initial) : moments(initial) {
    for (auto& row : residual) row.fill(Eigen::Array4d::Zero());
  }

  void add(const Eigen::Vector2d& uv, const BicubicBezier<Color>& model,
           const Eigen::Array4d& color, bool opaque) {
    const Powers u(uv.x()), v(uv.y());
    for (int q = 0; q < 7; ++q) {
      for (int p = 0; p < 7; ++p) moments[7 * q + p] += u.sextic[p] * v.sextic[q];
    }
    Eigen::Array4d difference = color;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        difference -= model.control[j][i].cast<double>() * (u.cubic[i] * v.cubic[j]);
      }
    }
    if (opaque) difference.w() = 0;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) residual[j][i] += difference * (u.cubic[i] * v.cubic[j]);
    }
  }

 private:
  struct Powers {
    std::array<double, 4> cubic;   ///< Bernstein polynomials
    std::array<double, 7> sextic;  ///< t^p (1 - t)^(6 - p)
    explicit Powers(double t) {
      const double s = 1 - t, s2 = s * s, t2 = t * t, s3 = s2 * s, t3 = t2 * t;
      cubic = {s3, 3 * s2 * t, 3 * s * t2, t3};
      sextic = {s3 * s3, s3 * s2 * t, s2 * s2 * t2, s3 * t3, s2 * t2 * t2, s * t2 * t3, t3 * t3};
    }
  };
};

bool on_outline(const Eigen::Vector2d& uv) {
  return uv.x() <= 0 || uv.x() >= 1 || uv.y() <= 0 || uv.y() >= 1;
}

double quad_area(const QuadMesh& mesh, int q) {
  const QuadMesh::Quad& c = mesh.quads()[q];
  const Eigen::Vector2d d = mesh.vertices[c[2]] - mesh.vertices[c[0]];
  const Eigen::Vector2d e = mesh.vertices[c[3]] - mesh.vertices[c[1]];
  return std::abs(0.5 * (d.x() * e.y() - d.y() * e.x()));
}

WedgeUnknowns unknowns_of(const Wedge& w) {
  WedgeUnknowns x;
  x.col(0) = w.value;
  x.col(1) = w.dx;
  x.col(2) = w.dy;
  x.col(3) = w.twist;
  return x;
}

}  // namespace

ColorSystem::ColorSystem(const PatchMesh& patches, const Raster& picture, double regularization,
                         const RunContext& context)
    : wedge_of_corner_(patches.wedge_of_corner),
      wedge_corners_(patches),
      mixed_(patches, picture),
      elements_(patches.patch_count()),
      scratch_(patches.patch_count()),
      inverse_blocks_(patches.wedges.size()) {
  right_hand_side.resize(patches.wedges.size());
  assemble(patches, picture, regularization, context);
  mixed_.evaluate_residual();
  for_each_range(wedge_count(), [&](int begin, int end) {
    for (int w = begin; w < end; ++w) {
      right_hand_side[w].setZero();
      for (const int h : wedge_corners_[w]) right_hand_side[w] += scratch_[h >> 2][h & 3];
      mixed_.gather(w, right_hand_side[w]);
    }
  });
  invert_blocks();
}

void ColorSystem::assemble(const PatchMesh& patches, const Raster& picture, double regularization,
                           const RunContext& context) {
  context.progress("fit", 0);
  const PatchScan scan(patches, SampleGrid{});
  for_each_range(patches.patch_count(), [&](int begin, int end) {
    for (int q = begin; q < end; ++q) {
      const SampleWindow window =
          intersection(scan.bounds(q), {0, 0, picture.width, picture.height});
      const std::array<CornerMap, 4> corners = corner_maps(patches, q);
      PatchSums sums(uniform_moments(
          regularization * (quad_area(patches.mesh, q) + kOpenWeight * mixed_.open_area(q))));
      if (!window.empty()) {
        CornerUnknowns start;
        for (int k = 0; k < 4; ++k) {
          start[k] = unknowns_of(patches.wedges[patches.wedge_of_corner[4 * q + k]]);
        }
        const BicubicBezier<Color> model = colors_of(corners, start);
        const auto geometry = patch_geometry(patches, q);
        const PatchInverse inverse(geometry);
        scan.scan(q, window, [&](int y, int x_begin, int x_end) {
          for (int x = x_begin; x < x_end; ++x) {
            if (mixed_.contains(x, y)) continue;
            const Eigen::Vector2d uv = inverse({x + 0.5, y + 0.5});
            // The outline is scanned as a polyline, so the centre may lie a little outside the
            // curve; then the picture counts at the nearest point of the patch.
            const Eigen::Array4d color = on_outline(uv)
                                             ? sample_bilinear(picture, geometry.at(uv.x(), uv.y()))
                                             : premultiplied_pixel(picture, x, y).cast<double>();
            sums.add(uv, model, color, !picture.has_alpha());
          }
        });
      }
      elements_[q].corners = corners;
      std::copy(sums.moments.begin(), sums.moments.end(), elements_[q].moments.begin());
      BicubicBezier<Color> gradient;
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) gradient.control[j][i] = sums.residual[j][i].cast<float>();
      }
      scratch_[q] = transpose_of(corners, gradient);
    }
  });
  context.progress("fit", 0.5);
}

void ColorSystem::invert_blocks() {
  // Four unit vectors pass through an element at once, one in each colour channel.
  for_each_range(static_cast<int>(elements_.size()), [&](int begin, int end) {
    for (int q = begin; q < end; ++q) {
      for (int k = 0; k < 4; ++k) {
        CornerUnknowns unit;
        for (WedgeUnknowns& x : unit) x.setZero();
        unit[k].setIdentity();
        scratch_[q][k] = quadrille::multiply(elements_[q], unit)[k];
      }
    }
  });
  for_each_range(wedge_count(), [&](int begin, int end) {
    for (int w = begin; w < end; ++w) {
      Eigen::Matrix4d block = mixed_.block(w);
      for (const int h : wedge_corners_[w]) block += scratch_[h >> 2][h & 3].cast<double>();
      // Unit diagonal first: the four unknowns differ by powers of the edge length.
      const Eigen::Vector4d scale = block.diagonal().cwiseSqrt().cwiseInverse();
      Eigen::Matrix4d scaled = scale.asDiagonal() * block * scale.asDiagonal();
      // Keeps the preconditioner positive definite where rounding of the element products does not.
      scaled.diagonal().array() += kBlockFloor;
      inverse_blocks_[w] =
          (scale.asDiagonal() * scaled.inverse() * scale.asDiagonal()).cast<float>();
    }
  });
}

Eigen::Array4d ColorSystem::multiply(const Vector& x, Vector& product) {
  for_each_range(static_cast<int>(elements_.size()), [&](int begin, int end) {
    for (int q = begin; q < end; ++q) {
      CornerUnknowns local;
      for (int k = 0; k < 4; ++k) local[k] = x[wedge_of_corner_[4 * q + k]];
      scratch_[q] = quadrille::multiply(elements_[q], local);
    }
  });
  mixed_.evaluate(x);
  return sum_over_ranges(wedge_count(), Eigen::Array4d(0, 0, 0, 0), [&](int begin, int end) {
    Eigen::Array4d sum = Eigen::Array4d::Zero();
    for (int w = begin; w < end; ++w) {
      product[w].setZero();
      for (const int h : wedge_corners_[w]) product[w] += scratch_[h >> 2][h & 3];
      mixed_.gather(w, product[w]);
      sum += x[w].cwiseProduct(product[w]).rowwise().sum().array().cast<double>();
    }
    return sum;
  });
}

}  // namespace quadrille
