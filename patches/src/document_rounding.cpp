#include "document_rounding.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "wedge_corners.h"

namespace quadrille {
namespace {

using Eigen::Array4d;
using Eigen::Matrix4d;
constexpr int kSweeps = 3;
constexpr double kLargest = 1 << 25;  // that document_colors.cpp codes

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
    for (Matrix4d& m : metric_) {
      // Vertices on one point have no metric; anything positive will do there.
      m.diagonal().array() += 1e-12 * m.trace() + 1e-30;
      root_.push_back(Eigen::LLT<Matrix4d>(m).matrixU());
    }
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
  std::vector<Matrix4d> metric_, root_;  ///< per wedge, and its Cholesky factor
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

  /// Works on all channels at once.
  void round(int w, bool first, WedgeCode& code) {
    const Matrix4d& root = root_[w];  // upper triangular, root^T root = metric
    const LocalColors slopes = slope(w);
    LocalColors wish = slopes;  // -metric^-1 slopes
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) wish[i] -= root(j, i) * wish[j];
      wish[i] /= root(i, i);
    }
    for (int i = 3; i >= 0; --i) {
      for (int j = i + 1; j < 4; ++j) wish[i] -= root(i, j) * wish[j];
      wish[i] /= root(i, i);
    }
    LocalColors number, change;
    for (int i = 3; i >= 0; --i) {
      Array4d to = -wish[i];
      for (int j = i + 1; j < 4; ++j) to -= root(i, j) / root(i, i) * (wish[j] + change[j]);
      const Array4d at = exact_[w][i] + errors_[w][i];
      number[i] = ((at + to) / step_[i] + 0.5).floor().max(-kLargest).min(kLargest);
      change[i] = number[i] * step_[i] - at;
    }
    Array4d gain = Array4d::Zero();
    for (int i = 0; i < 4; ++i) {
      Array4d bent = Array4d::Zero();
      for (int j = 0; j < 4; ++j) bent += metric_[w](i, j) * change[j];
      gain += (2 * slopes[i] + bent) * change[i];
    }
    for (int c = 0; c < kChannels; ++c) {
      if (!first && !(gain[c] < 0)) continue;
      for (int i = 0; i < 4; ++i) set(w, c, i, static_cast<int>(number[i][c]), code);
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
