#include "quadrille/fit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>

#include "exactly_opaque.h"
#include "paint.h"
#include "patch_scan.h"
#include "quadrille/error.h"
#include "quadrille/patch_geometry.h"
#include "support/irregular_mesh.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;
using testing::irregular_mesh;
using testing::lattice;
using testing::paint;
using testing::Painter;
using testing::Random;

/// Waves with a sharp disc in the middle.
Raster busy_picture(int width, int height, int channels = 3) {
  return paint(width, height, channels, 1, [&](double x, double y) -> std::array<double, 4> {
    const double r = std::hypot(x - width / 2.0, y - height / 2.0);
    const double disc = r < 0.3 * std::min(width, height) ? 0.4 : 0;
    return {0.5 + 0.3 * std::sin(0.7 * x) * std::cos(0.4 * y), 0.3 + disc,
            0.5 + 0.4 * std::sin(0.05 * x * y), 0.2 + disc};
  });
}

/// The unclamped colours of the patches at all pixel centres; every one must be covered.
std::vector<Color> colors_at_pixels(const PatchMesh& patches, int width, int height) {
  std::vector<Color> colors(static_cast<std::size_t>(width) * height,
                            Color::Constant(std::numeric_limits<float>::quiet_NaN()));
  const PatchScan scan(patches, SampleGrid{});
  for (int q = 0; q < patches.patch_count(); ++q) {
    const FergusonPatch patch = ferguson_patch(patches, q);
    const PatchInverse inverse(patch.position);
    scan.scan(q, intersection(scan.bounds(q), {0, 0, width, height}),
              [&](int y, int x_begin, int x_end) {
                for (int x = x_begin; x < x_end; ++x) {
                  const Vector2d uv = inverse({x + 0.5, y + 0.5});
                  colors[static_cast<std::size_t>(y) * width + x] = patch.color.at(uv.x(), uv.y());
                }
              });
  }
  return colors;
}

/// Largest and mean difference from the premultiplied picture.
struct Difference {
  double largest = 0, mean = 0, squares = 0;
};

Difference difference(const PatchMesh& patches, const Raster& picture) {
  const auto colors = colors_at_pixels(patches, picture.width, picture.height);
  Difference d;
  for (int i = 0; i < picture.width * picture.height; ++i) {
    const float* p = picture.data.data() + static_cast<std::size_t>(i) * picture.channels;
    const float alpha = picture.has_alpha() ? p[3] : 1;
    for (int k = 0; k < picture.channels; ++k) {
      const double e = std::abs(colors[i][k] - (k < 3 ? p[k] * alpha : alpha));
      d.largest = std::isnan(e) ? e : std::max(d.largest, e);
      d.mean += e;
      d.squares += e * e;
    }
  }
  d.mean /= static_cast<double>(picture.data.size());
  return d;
}

bool same_wedges(const PatchMesh& a, const PatchMesh& b) {
  return a.wedges.size() == b.wedges.size() &&
         std::memcmp(a.wedges.data(), b.wedges.data(), a.wedges.size() * sizeof(Wedge)) == 0;
}

class FitByAnyMethod : public ::testing::TestWithParam<FitMethod> {
 protected:
  FitOptions options() const {
    FitOptions o;
    o.method = GetParam();
    return o;
  }
};

INSTANTIATE_TEST_SUITE_P(Fit, FitByAnyMethod,
                         ::testing::Values(FitMethod::bessel, FitMethod::bessel_ls,
                                           FitMethod::hermite),
                         [](const auto& method) {
                           return method.param == FitMethod::bessel      ? "bessel"
                                  : method.param == FitMethod::bessel_ls ? "bessel_ls"
                                                                         : "hermite";
                         });

TEST_P(FitByAnyMethod, ReproducesLinearColoursOnAnyMesh) {
  const Eigen::Array4d base(0.2, 0.7, 0.5, 1), x(0.004, -0.003, 0.001, 0), y(0.002, -0.001, 0, 0);
  const Raster picture = paint(60, 44, 3, 1, [&](double px, double py) -> std::array<double, 4> {
    const Eigen::Array4d c = base + x * px + y * py;
    return {c[0], c[1], c[2], 1};
  });
  std::vector<PatchMesh> meshes;
  for (int seed = 0; seed < 4; ++seed) {
    meshes.push_back(fit_patches(irregular_mesh(5, 4, 60, 44, seed), picture, options()));
    meshes.push_back(fit_patches(testing::wild_lattice(6, 5, 60, 44, seed), picture, options()));
    meshes.push_back(testing::random_patches(7, 5, 60, 44, seed));
    fit_colors(meshes.back(), picture, options());
  }
  for (const PatchMesh& patches : meshes) {
    const QuadMesh& mesh = patches.mesh;
    for (int h = 0; h < mesh.halfedge_count(); ++h) {
      const Vector2d p = mesh.vertices[mesh.origin(h)];
      const Wedge& w = patches.wedges[patches.wedge_of_corner[h]];
      const Eigen::Array4d expected = base + x * p.x() + y * p.y();
      EXPECT_LT((w.value.cast<double>() - expected).abs().maxCoeff(), 1e-6);
      EXPECT_LT((w.dx.cast<double>() - x).abs().maxCoeff(), 1e-6);
      EXPECT_LT((w.dy.cast<double>() - y).abs().maxCoeff(), 1e-6);
      EXPECT_LT(w.twist.abs().maxCoeff(), 1e-6);
    }
    // Outlines are scanned as polylines within 1/128 pixel of the curve.
    EXPECT_LT(difference(patches, picture).largest, 5e-5);
    EXPECT_LT(difference(patches, picture).mean, 1e-6);
  }
}

TEST_P(FitByAnyMethod, KeepsRgbExactlyOpaque) {
  const PatchMesh patches =
      fit_patches(irregular_mesh(4, 4, 32, 32, 1), busy_picture(32, 32), options());
  testing::expect_exactly_opaque(patches);
}

TEST_P(FitByAnyMethod, KeepsConstantAlpha) {
  Raster picture = busy_picture(40, 30, 4);
  for (std::size_t i = 3; i < picture.data.size(); i += 4) picture.data[i] = 0.375f;
  const PatchMesh patches = fit_patches(irregular_mesh(4, 3, 40, 30, 2), picture, options());
  EXPECT_FALSE(patches.opaque);
  for (const Color& c : colors_at_pixels(patches, 40, 30)) EXPECT_NEAR(c[3], 0.375, 1e-6);
}

TEST_P(FitByAnyMethod, IgnoresTheColourOfTransparentPixels) {
  Raster picture = busy_picture(24, 24, 4);
  for (std::size_t i = 3; i < picture.data.size(); i += 4) picture.data[i] = 0;
  const PatchMesh patches = fit_patches(lattice(5, 5, 24, 24), picture, options());
  for (const Wedge& w : patches.wedges) {
    EXPECT_TRUE((w.value == 0).all() && (w.dx == 0).all() && (w.dy == 0).all());
  }
}

TEST_P(FitByAnyMethod, SurvivesPatchesSmallerThanPixels) {
  // Where all pixels lie on one line, slopes across it only follow from the scheme.
  const float beyond = GetParam() == FitMethod::bessel_ls ? 2 : 1;
  constexpr int kSizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {2, 2}, {1, 300}};
  for (const auto& [width, height] : kSizes) {
    const Raster picture = busy_picture(width, height, 4);
    const int columns = width > 2 ? 15 : 5, rows = height > 2 ? 15 : 5;
    for (const QuadMesh& mesh :
         {lattice(columns, rows, width, height), lattice(1, 1, width, height),
          irregular_mesh(4, 4, width, height, 3)}) {
      const PatchMesh patches = fit_patches(mesh, picture, options());
      for (const Wedge& w : patches.wedges) {
        ASSERT_TRUE(w.dx.allFinite() && w.dy.allFinite() && w.twist.allFinite());
        ASSERT_TRUE((w.value > -beyond).all() && (w.value < 1 + beyond).all())
            << width << " x " << height;
      }
      EXPECT_LT(difference(patches, picture).mean, 0.5);
    }
  }
}

TEST_P(FitByAnyMethod, OnePixelIsOneColour) {
  const Raster picture = paint(1, 1, 3, 1, [](double, double) {
    return std::array{0.2, 0.4, 0.9, 1.0};
  });
  const PatchMesh patches = fit_patches(irregular_mesh(6, 6, 1, 1, 4), picture, options());
  for (const Wedge& w : patches.wedges) {
    EXPECT_LT((w.value - Color(0.2f, 0.4f, 0.9f, 1)).abs().maxCoeff(), 1e-6);
    EXPECT_LT(w.dx.abs().maxCoeff() + w.dy.abs().maxCoeff(), 1e-6);
  }
}

TEST_P(FitByAnyMethod, IsTheSameForAnyNumberOfThreads) {
  const Raster picture = busy_picture(120, 90, 4);
  const auto fit = [&](int threads) {
    RunContext context;
    context.threads = threads;
    return fit_patches(irregular_mesh(12, 9, 120, 90, 5), picture, options(), context);
  };
  const PatchMesh one = fit(1);
  EXPECT_TRUE(same_wedges(one, fit(2)));
  EXPECT_TRUE(same_wedges(one, fit(3)));
}

TEST_P(FitByAnyMethod, LetsColoursJumpAtTears) {
  QuadMesh mesh = lattice(4, 4, 40, 40);
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.vertices[mesh.origin(h)].x() == 20 && mesh.vertices[mesh.tip(h)].x() == 20) {
      mesh.edge_flags[mesh.edge(h)] |= kTearEdge;
    }
  }
  const Raster picture = paint(40, 40, 3, 1, [](double x, double y) -> std::array<double, 4> {
    if (x < 20) return {0.1, 0.01 * y, 0.9, 1};
    return {0.9, 0.5, 0.02 * (x - 20), 1};
  });
  EXPECT_LT(difference(fit_patches(mesh, picture, options()), picture).largest, 1e-5);
}

TEST(Fit, HermiteReproducesBicubicPolynomialsOnALattice) {
  const auto cubic = [](double t, double a) { return a + t * (0.5 - t * (1.3 - t)); };
  const Painter painter = [&](double x, double y) -> std::array<double, 4> {
    const double s = x / 48, t = y / 36;
    return {cubic(s, 0.3) * cubic(t, 0.6), cubic(s, 0.1), s * s * s * t * t * t, 1};
  };
  const Raster picture = paint(48, 36, 3, 1, painter);
  FitOptions options;
  options.regularization = 1e-9;
  options.tolerance = 1e-7;
  // The corner at which a quad starts must not matter.
  const QuadMesh regular = lattice(6, 5, 48, 36);
  std::vector<QuadMesh::Quad> quads = regular.quads();
  Random random(6);
  for (auto& q : quads) std::rotate(q.begin(), q.begin() + random.integer(0, 3), q.end());
  const PatchMesh patches = fit_patches(QuadMesh(regular.vertices, quads), picture, options);
  EXPECT_LT(difference(patches, picture).largest, 2e-6);
  for (int q = 0; q < patches.patch_count(); ++q) {
    const FergusonPatch patch = ferguson_patch(patches, q);
    for (const double u : {0.0, 0.37, 1.0}) {
      const Vector2d p = patch.position.at(u, 1 - u * u);
      const auto expected = painter(p.x(), p.y());
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(patch.color.at(u, 1 - u * u)[k], expected[k], 1e-4);
      }
    }
  }
}

TEST(Fit, MoreUnknownsComeCloser) {
  const Raster picture = busy_picture(80, 60, 4);
  for (int seed = 0; seed < 4; ++seed) {
    FitOptions bessel, bessel_ls, hermite;
    bessel.method = FitMethod::bessel;
    bessel_ls.method = FitMethod::bessel_ls;
    PatchMesh patches = testing::random_patches(14, 10, 80, 60, seed);
    EXPECT_EQ(fit_colors(patches, picture, bessel).iterations, 0);
    const double sampled = difference(patches, picture).squares;
    const FitReport one_color = fit_colors(patches, picture, bessel_ls);
    const double by_colors = difference(patches, picture).squares;
    const FitReport report = fit_colors(patches, picture, hermite);
    EXPECT_LT(by_colors, 0.9 * sampled);
    EXPECT_LT(difference(patches, picture).squares, 0.9 * by_colors);
    EXPECT_LT(difference(patches, picture).squares, 0.7 * sampled);
    EXPECT_LE(one_color.residual, bessel_ls.tolerance);
    EXPECT_LT(one_color.iterations, 100);
    EXPECT_LE(report.residual, hermite.tolerance);
    EXPECT_LT(report.iterations, 60);
  }
}

/// What the pixels' least squares and the tiny damping ask for together: a step in any direction
/// that the method allows makes it worse.
TEST(Fit, BesselLsFindsTheBestColours) {
  const Raster picture = busy_picture(48, 36);
  FitOptions options;
  options.method = FitMethod::bessel_ls;
  options.regularization = 1e-9;
  options.tolerance = 1e-6;
  const QuadMesh mesh = lattice(6, 5, 48, 36);
  const PatchMesh best = fit_patches(mesh, picture, options);
  const double least = difference(best, picture).squares;
  Random random(4);
  for (int i = 0; i < 10; ++i) {
    // The colours that the scheme gives other pictures are the method's space.
    const double a = random.uniform(0.1, 1), b = random.uniform(0.1, 1);
    const Raster other = paint(48, 36, 3, 1, [&](double x, double y) -> std::array<double, 4> {
      return {0.5 + 0.5 * std::sin(a * x), 0.5 + 0.5 * std::cos(b * y), std::sin(a * x * b), 1};
    });
    FitOptions sampled;
    sampled.method = FitMethod::bessel;
    const PatchMesh direction = fit_patches(mesh, other, sampled);
    for (const float step : {-1e-2f, 1e-2f}) {
      PatchMesh moved = best;
      for (std::size_t w = 0; w < moved.wedges.size(); ++w) {
        for (int k = 0; k < 3; ++k) {
          moved.wedges[w].value[k] += step * direction.wedges[w].value[k];
          moved.wedges[w].dx[k] += step * direction.wedges[w].dx[k];
          moved.wedges[w].dy[k] += step * direction.wedges[w].dy[k];
        }
      }
      EXPECT_GT(difference(moved, picture).squares, least);
    }
  }
}

/// Projection of n samples onto C1 piecewise cubics of k pieces.
Eigen::MatrixXd cubic_projection(int n, int k) {
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n, 2 * (k + 1));
  for (int row = 0; row < n; ++row) {
    const double t = (row + 0.5) / n * k;
    const int piece = std::min(static_cast<int>(t), k - 1);
    const auto basis = hermite_basis(t - piece);
    for (int i = 0; i < 4; ++i) b(row, 2 * piece + i) = basis[i];
  }
  return b * (b.transpose() * b).ldlt().solve(b.transpose());
}

TEST(Fit, HermiteAgreesWithTheSeparableProjectionOnALattice) {
  const int width = 97, height = 66, columns = 13, rows = 9;
  const Raster picture = busy_picture(width, height);
  const PatchMesh patches = fit_patches(lattice(columns, rows, width, height), picture);
  const auto colors = colors_at_pixels(patches, width, height);
  const Eigen::MatrixXd across = cubic_projection(width, columns);
  const Eigen::MatrixXd down = cubic_projection(height, rows);
  double expected_mae = 0, largest = 0;
  for (int k = 0; k < 3; ++k) {
    Eigen::MatrixXd channel(height, width);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) channel(y, x) = picture.pixel(x, y)[k];
    }
    const Eigen::MatrixXd expected = down * channel * across.transpose();
    expected_mae += (expected - channel).cwiseAbs().mean() / 3;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        largest = std::max(largest, std::abs(colors[y * width + x][k] - expected(y, x)));
      }
    }
  }
  EXPECT_NEAR(difference(patches, picture).mean, expected_mae, 0.01 * expected_mae);
  EXPECT_LT(largest, 2e-3);
}

TEST(Fit, RejectsWhatItCannotFit) {
  const auto code_of = [](PatchMesh patches, const Raster& picture, const FitOptions& options,
                          const RunContext& context = {}) {
    try {
      fit_colors(patches, picture, options, context);
    } catch (const Error& e) {
      return e.code();
    }
    return ErrorCode::numerical_failure;
  };
  const PatchMesh patches = straight_patches(lattice(2, 2, 4, 4));
  const Raster picture(4, 4, 3);
  EXPECT_EQ(code_of({}, picture, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(patches, Raster(), {}), ErrorCode::invalid_argument);
  FitOptions options;
  options.regularization = 0;
  EXPECT_EQ(code_of(patches, picture, options), ErrorCode::invalid_argument);
  options = {};
  options.tolerance = std::nan("");
  EXPECT_EQ(code_of(patches, picture, options), ErrorCode::invalid_argument);
  options = {};
  options.max_iterations = 0;
  EXPECT_EQ(code_of(patches, picture, options), ErrorCode::invalid_argument);
  RunContext context;
  context.on_progress = [](const std::string&, double) { return false; };
  EXPECT_EQ(code_of(patches, picture, {}, context), ErrorCode::cancelled);
}

}  // namespace
}  // namespace quadrille
