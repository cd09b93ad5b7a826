#include "document_metric.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace quadrille {
namespace {

using Eigen::Array4d;
using Eigen::Matrix4d;

/// Integrals of products of the cubic Hermite basis: value and derivative at 0, then at 1.
constexpr double kLine[4][4] = {{156 / 420., 22 / 420., 54 / 420., -13 / 420.},
                                {22 / 420., 4 / 420., 13 / 420., -3 / 420.},
                                {54 / 420., 13 / 420., 156 / 420., -22 / 420.},
                                {-13 / 420., -3 / 420., -22 / 420., 4 / 420.}};

/// The same over a patch, in the order of PatchColors.
struct PatchProducts {
  double of[16][16] = {};
  constexpr PatchProducts() {
    constexpr int kAtU[4] = {0, 1, 1, 0}, kAtV[4] = {0, 0, 1, 1};
    for (int a = 0; a < 16; ++a) {
      for (int b = 0; b < 16; ++b) {
        of[a][b] = kLine[2 * kAtU[a / 4] + (a & 1)][2 * kAtU[b / 4] + (b & 1)] *
                   kLine[2 * kAtV[a / 4] + (a >> 1 & 1)][2 * kAtV[b / 4] + (b >> 1 & 1)];
      }
    }
  }
};
constexpr PatchProducts kProducts;

/// The Cholesky factor of m. What has none, as numbers are out of proportion, becomes the nearest
/// form that has: its diagonal or, failing that, the identity.
Matrix4d factorize(Matrix4d& m) {
  if (!m.allFinite()) m.setIdentity();
  const Eigen::LLT<Matrix4d> factor(m);
  const Matrix4d root = factor.matrixU();
  if (factor.info() == Eigen::Success && root.allFinite()) return root;
  m = Matrix4d(m.diagonal().asDiagonal());
  return m.cwiseSqrt();
}

}  // namespace

PictureMetric::PictureMetric(const PatchMesh& patches, const std::vector<ColorFrame>& frames)
    : corners_(patches),
      to_patch_(patches.wedge_of_corner.size()),
      area_(patches.patch_count()),
      block_(patches.wedges.size(), Matrix4d::Zero()) {
  for (int q = 0; q < patches.patch_count(); ++q) measure(patches, frames, q);
  for (Matrix4d& m : block_) {
    // Vertices on one point have no metric; anything positive will do there.
    m.diagonal().array() += 1e-12 * m.trace() + 1e-30;
    root_.push_back(factorize(m));
  }
}

void PictureMetric::measure(const PatchMesh& patches, const std::vector<ColorFrame>& frames,
                            int q) {
  const QuadMesh& mesh = patches.mesh;
  const auto& c = mesh.quads()[q];
  area_[q] = std::abs(quad_area(mesh, q));
  const BicubicHermite<Eigen::Vector2d> g = patch_geometry(patches, q);
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
      for (int j = 0; j < 4; ++j) own(i, j) = area_[q] * kProducts.of[4 * k + i][4 * k + j];
    }
    block_[patches.wedge_of_corner[h]] += m.transpose() * own * m;
  }
}

LocalColors PictureMetric::solve_block(int wedge, LocalColors x) const {
  const Matrix4d& root = root_[wedge];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) x[i] -= root(j, i) * x[j];
    x[i] /= root(i, i);
  }
  for (int i = 3; i >= 0; --i) {
    for (int j = i + 1; j < 4; ++j) x[i] -= root(i, j) * x[j];
    x[i] /= root(i, i);
  }
  return x;
}

void PictureMetric::put(int h, const LocalColors& wedge, PatchColors& patch) const {
  const Matrix4d& m = to_patch_[h];
  Array4d* colors = &patch[4 * QuadMesh::corner_of(h)];
  colors[0] = wedge[0];
  for (int i = 1; i < 4; ++i) colors[i] = wedge[1] * m(i, 1) + wedge[2] * m(i, 2);
  colors[3] += wedge[3] * m(3, 3);
}

void PictureMetric::add_product(int h, const PatchColors& patch, LocalColors& wedge) const {
  const int k = QuadMesh::corner_of(h);
  PatchColors integrals;
  for (int i = 4 * k; i < 4 * k + 4; ++i) {
    Array4d s = Array4d::Zero();
    for (int j = 0; j < 16; ++j) s += patch[j] * kProducts.of[i][j];
    integrals[i] = s;
  }
  add_integrals(h, integrals, wedge);
}

PatchColors PictureMetric::products(const PatchColors& patch) {
  // By corner and derivative along u first, then along v.
  constexpr int kOf[4][4] = {{0, 2, 12, 14}, {1, 3, 13, 15}, {4, 6, 8, 10}, {5, 7, 9, 11}};
  Array4d along_u[4][4];
  for (int v = 0; v < 4; ++v) {
    for (int i = 0; i < 4; ++i) {
      along_u[i][v] = kLine[i][0] * patch[kOf[0][v]] + kLine[i][1] * patch[kOf[1][v]] +
                      kLine[i][2] * patch[kOf[2][v]] + kLine[i][3] * patch[kOf[3][v]];
    }
  }
  PatchColors result;
  for (int i = 0; i < 4; ++i) {
    for (int v = 0; v < 4; ++v) {
      result[kOf[i][v]] = kLine[v][0] * along_u[i][0] + kLine[v][1] * along_u[i][1] +
                          kLine[v][2] * along_u[i][2] + kLine[v][3] * along_u[i][3];
    }
  }
  return result;
}

void PictureMetric::add_integrals(int h, const PatchColors& integrals, LocalColors& wedge) const {
  const Matrix4d& m = to_patch_[h];
  const double area = area_[QuadMesh::quad_of(h)];
  const Array4d* s = &integrals[4 * QuadMesh::corner_of(h)];
  wedge[0] += area * s[0];
  for (int kind = 1; kind < 3; ++kind) {
    for (int i = 1; i < 4; ++i) wedge[kind] += (area * m(i, kind)) * s[i];
  }
  wedge[3] += (area * m(3, 3)) * s[3];
}

}  // namespace quadrille
