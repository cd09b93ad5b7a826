#include "document_rounding.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "wedge_corners.h"

namespace quadrille {
namespace {

using Eigen::Array4d;
using Eigen::Matrix4d;
constexpr int kSweeps = 3;

/// Integrals of products of the cubic Hermite basis: value and derivative at 0, then at 1.
constexpr double kLine[4][4] = {{156 / 420., 22 / 420., 54 / 420., -13 / 420.},
                                {22 / 420., 4 / 420., 13 / 420., -3 / 420.},
                                {54 / 420., 13 / 420., 156 / 420., -22 / 420.},
                                {-13 / 420., -3 / 420., -22 / 420., 4 / 420.}};

/// The same over a patch; number 4 k + i is value, u, v or mixed derivative i of corner k.
struct PatchProducts {
  double of[16][16];
  PatchProducts() {
    constexpr int kAtU[4] = {0, 1, 1, 0}, kAtV[4] = {0, 0, 1, 1};
    for (int a = 0; a < 16; ++a) {
      for (int b = 0; b < 16; ++b) {
        of[a][b] = kLine[2 * kAtU[a / 4] + (a & 1)][2 * kAtU[b / 4] + (b & 1)] *
                   kLine[2 * kAtV[a / 4] + (a >> 1 & 1)][2 * kAtV[b / 4] + (b >> 1 & 1)];
      }
    }
  }
};

class Rounding {
 public:
  Rounding(const PatchMesh& patches, const std::vector<ColorFrame>& frames,
           const std::vector<LocalColors>& exact, double color_step)
      : patches_(patches),
        corners_(patches),
        exact_(exact),
        to_patch_(patches.wedge_of_corner.size()),
        area_(patches.patch_count()),
        metric_(exact.size(), Matrix4d::Zero()),
        errors_(exact.size()),
        patch_errors_(patches.patch_count()) {
    for (int kind = 0; kind < 4; ++kind) {
      for (int c = 0; c < kChannels; ++c) {
        step_[kind][c] = color_step_of(c, static_cast<WedgeKind>(kind), color_step);
      }
      for (LocalColors& e : errors_) e[kind].setZero();
    }
    for (auto& e : patch_errors_) e.fill(Array4d::Zero());
    for (int q = 0; q < patches.patch_count(); ++q) measure(q, frames);
  }

  std::vector<WedgeCode> codes() {
    std::vector<WedgeCode> codes(exact_.size());
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (int w = 0; w < static_cast<int>(codes.size()); ++w) round(w, sweep == 0, codes[w]);
    }
    return codes;
  }

 private:
  const PatchMesh& patches_;
  WedgeCorners corners_;
  const std::vector<LocalColors>& exact_;
  const PatchProducts products_;
  LocalColors step_;
  std::vector<Matrix4d> to_patch_;  ///< per corner: kinds -> value and derivatives of the patch
  std::vector<double> area_;        ///< per patch
  std::vector<Matrix4d> metric_;    ///< per wedge
  std::vector<LocalColors> errors_;
  std::vector<std::array<Array4d, 16>> patch_errors_;

  void measure(int q, const std::vector<ColorFrame>& frames) {
    const QuadMesh& mesh = patches_.mesh;
    const auto& c = mesh.quads()[q];
    const Eigen::Vector2d d = mesh.vertices[c[2]] - mesh.vertices[c[0]];
    const Eigen::Vector2d e = mesh.vertices[c[3]] - mesh.vertices[c[1]];
    area_[q] = std::abs(d.x() * e.y() - d.y() * e.x()) / 2;
    const BicubicHermite<Eigen::Vector2d> g = patch_geometry(patches_, q);
    for (int k = 0; k < 4; ++k) {
      const int h = 4 * q + k;
      const ColorFrame& frame = frames[c[k]];
      Matrix4d& m = to_patch_[h];
      m.setZero();
      m(0, 0) = 1;
      m.block<1, 2>(1, 1) = (frame.inverse * g.du[k]).transpose();
      m.block<1, 2>(2, 1) = (frame.inverse * g.dv[k]).transpose();
      m.block<1, 2>(3, 1) = (frame.inverse * g.duv[k]).transpose();
      m(3, 3) = twist_sign(mesh, h) * g.du[k].norm() * g.dv[k].norm() / frame.area;
      Matrix4d own;
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) own(i, j) = area_[q] * products_.of[4 * k + i][4 * k + j];
      }
      metric_[patches_.wedge_of_corner[h]] += m.transpose() * own * m;
    }
  }

  /// Half the derivative of the squared error of the picture with respect to the wedge's kinds.
  LocalColors slope(int w) const {
    LocalColors slope;
    for (Array4d& s : slope) s.setZero();
    for (const int h : corners_[w]) {
      const int q = QuadMesh::quad_of(h), k = QuadMesh::corner_of(h);
      for (int i = 0; i < 4; ++i) {
        Array4d s = Array4d::Zero();
        for (int j = 0; j < 16; ++j) s += patch_errors_[q][j] * products_.of[4 * k + i][j];
        s *= area_[q];
        for (int kind = 0; kind < 4; ++kind) slope[kind] += s * to_patch_[h](i, kind);
      }
    }
    return slope;
  }

  void round(int w, bool first, WedgeCode& code) {
    const Matrix4d& metric = metric_[w];
    const Eigen::LLT<Matrix4d> root(metric + 1e-12 * metric.trace() * Matrix4d::Identity());
    if (root.info() != Eigen::Success) return round_alone(w, code);
    const Matrix4d upper = root.matrixU();
    const LocalColors slopes = slope(w);
    for (int c = 0; c < kChannels; ++c) {
      const Eigen::Vector4d g(slopes[0][c], slopes[1][c], slopes[2][c], slopes[3][c]);
      const Eigen::Vector4d wish = -root.solve(g);
      Eigen::Vector4d change;
      std::array<int, 4> number;
      for (int i = 3; i >= 0; --i) {
        double to = wish[i];
        for (int j = i + 1; j < 4; ++j) to += upper(i, j) / upper(i, i) * (wish[j] - change[j]);
        const double at = exact_[w][i][c] + errors_[w][i][c];
        number[i] = static_cast<int>(std::floor((at + to) / step_[i][c] + 0.5));
        change[i] = number[i] * step_[i][c] - at;
      }
      if (!first && 2 * g.dot(change) + change.dot(metric * change) >= 0) continue;
      for (int i = 0; i < 4; ++i) set(w, c, i, number[i], code);
    }
    spread(w);
  }

  void round_alone(int w, WedgeCode& code) {
    for (int c = 0; c < kChannels; ++c) {
      for (int i = 0; i < 4; ++i) {
        set(w, c, i, static_cast<int>(std::floor(exact_[w][i][c] / step_[i][c] + 0.5)), code);
      }
    }
    spread(w);
  }

  void set(int w, int c, int kind, int number, WedgeCode& code) {
    code[c][kind] = number;
    errors_[w][kind][c] = number * step_[kind][c] - exact_[w][kind][c];
  }

  /// Tells the patches at a wedge its errors.
  void spread(int w) {
    for (const int h : corners_[w]) {
      auto& patch = patch_errors_[QuadMesh::quad_of(h)];
      for (int i = 0; i < 4; ++i) {
        Array4d& error = patch[4 * QuadMesh::corner_of(h) + i];
        error.setZero();
        for (int kind = 0; kind < 4; ++kind) error += errors_[w][kind] * to_patch_[h](i, kind);
      }
    }
  }
};

}  // namespace

std::vector<WedgeCode> round_colors(const PatchMesh& patches, const std::vector<ColorFrame>& frames,
                                    const std::vector<LocalColors>& exact, double color_step) {
  return Rounding(patches, frames, exact, color_step).codes();
}

}  // namespace quadrille
