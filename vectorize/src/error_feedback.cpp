#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "count_meshing.h"
#include "meshed_region.h"
#include "opencv_errors.h"
#include "premultiplied_colours.h"
#include "quadrille/alpha_outline.h"
#include "quadrille/error.h"
#include "quadrille/vectorize.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

// The error of a quad of size h grows as C sqrt(h), and the wished h as C^(-1/2.5); so the density
// 1 / h^2 grows as this power of the error times that of the size.
constexpr double kErrorPower = 0.8, kSizePower = 1.6;
constexpr double kLeastError = 0.15;   // of the mean: flat areas stay covered
constexpr double kMostChange = 6;      // of the density, either way
constexpr double kWindow = 0.35;       // sigma of the error's window, in edges
constexpr double kBesideChain = 2;     // pixels on either side whose error a chain answers for
constexpr double kWorstCorner = 0.18;  // sine; chains that lead to worse ones are not followed
constexpr int kMeshRounds = 4;
// Quads per cell grow by as much where the mesh is graded by the error, and by so many times the
// share of the vertices that lie on chains, which stay apart where others merge; as measured.
constexpr double kGradingGain = 1.01, kChainGain = 1.2;
constexpr double kLeastCounted = 0.02;  // share of pixels that a mean takes for granted

/// Squared distance of the premultiplied colours of each pixel.
FieldGrid<float> squared_error(const Raster& shown, const Raster& fitted) {
  const PremultipliedColours a(shown), b(fitted);
  const bool both_opaque = !shown.has_alpha() && !fitted.has_alpha();
  FieldGrid<float> error(shown.width, shown.height);
  for (int y = 0; y < shown.height; ++y) {
    for (int x = 0; x < shown.width; ++x) {
      Eigen::Vector4f d = a.pixel(x, y) - b.pixel(x, y);
      if (!both_opaque && !shown.has_alpha()) d[3] = 1 - b.pixel(x, y)[3];
      if (!both_opaque && !fitted.has_alpha()) d[3] = a.pixel(x, y)[3] - 1;
      error(x, y) = d.squaredNorm();
    }
  }
  return error;
}

/// 1 at the pixels whose error counts, 0 beside the chains: there it is expected to go away.
cv::Mat counted_pixels(const FieldGrid<float>& error, const ChainNetwork& chains) {
  cv::Mat counted(error.height, error.width, CV_32F, cv::Scalar(1));
  for (const FeatureChain& chain : chains.chains) {
    for (const Vector2d& p : chain.points) {
      cv::circle(counted, {static_cast<int>(p.x()), static_cast<int>(p.y())},
                 static_cast<int>(kBesideChain), cv::Scalar(0), cv::FILLED);
    }
  }
  return counted;
}

/// How many times as many quads per area the error asks for, at the working pixels.
FieldGrid<float> error_density(const Quadrangulation& quads, const FieldGrid<float>& error) {
  const int w = quads.scale.along_x.width, h = quads.scale.along_x.height;
  const cv::Mat counted = counted_pixels(error, quads.chains);
  cv::Mat source(error.height, error.width, CV_32F), mean, weight;
  for (int y = 0; y < error.height; ++y) {
    for (int x = 0; x < error.width; ++x) {
      source.at<float>(y, x) = counted.at<float>(y, x) * std::sqrt(error(x, y));
    }
  }
  cv::resize(source, mean, {w, h}, 0, 0, cv::INTER_AREA);
  cv::resize(counted, weight, {w, h}, 0, 0, cv::INTER_AREA);
  FieldGrid<float> size(w, h);
  for (std::size_t i = 0; i < size.data.size(); ++i) {
    size.data[i] = std::sqrt(quads.scale.along_x.data[i] * quads.scale.along_y.data[i]);
  }
  const double mean_size =
      std::accumulate(size.data.begin(), size.data.end(), 0.0) / size.data.size();
  for (cv::Mat* m : {&mean, &weight}) {
    cv::GaussianBlur(*m, *m, {}, std::max(0.5, kWindow * mean_size), 0, cv::BORDER_REPLICATE);
  }
  mean /= weight + kLeastCounted;
  const double mean_error = std::max(cv::mean(mean)[0], 1e-6);
  FieldGrid<float> density(w, h);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const double lacking =
          std::pow(mean.at<float>(y, x) / mean_error + kLeastError, kErrorPower) *
          std::pow(size(x, y) / mean_size, kSizePower);
      density(x, y) = static_cast<float>(std::clamp(lacking, 1 / kMostChange, kMostChange));
    }
  }
  return density;
}

/// Keeps the chains beside which there is more error per vertex than in the mesh on average.
void keep_worthwhile(ChainNetwork& network, const FieldGrid<float>& error, double spacing,
                     double vertices, double least_gain) {
  const double usual =
      std::accumulate(error.data.begin(), error.data.end(), 0.0) / std::max(1.0, vertices);
  std::erase_if(network.chains, [&](FeatureChain& chain) {
    double sum = 0;
    for (std::size_t i = 1; i < chain.points.size(); ++i) {
      const Vector2d step = chain.points[i] - chain.points[i - 1];
      const double length = step.norm();
      if (!(length > 0)) continue;
      const Vector2d normal(-step.y() / length, step.x() / length);
      for (double t = 0.5 - kBesideChain; t < kBesideChain; t += 1) {
        const Vector2d p = 0.5 * (chain.points[i - 1] + chain.points[i]) + t * normal;
        const int x = std::clamp(static_cast<int>(p.x()), 0, error.width - 1);
        const int y = std::clamp(static_cast<int>(p.y()), 0, error.height - 1);
        sum += length * error(x, y);
      }
    }
    chain.gain = sum / (1 + chain.length / spacing);
    return chain.gain < least_gain * usual;
  });
}

/// Leaves out the chains that pass quads with a bad corner; false when there are none.
bool leave_out_bad_chains(Quadrangulation& quads, double reach) {
  std::vector<Vector2d> places;
  for (int q = 0; q < quads.mesh.quad_count(); ++q) {
    if (scaled_jacobian(quads.mesh, q) >= kWorstCorner) continue;
    places.push_back(quads.mesh.vertices[quads.mesh.quads()[q][0]]);
  }
  return std::erase_if(quads.chains.chains, [&](const FeatureChain& chain) {
           return std::any_of(places.begin(), places.end(), [&](const Vector2d& place) {
             return std::any_of(chain.points.begin(), chain.points.end(),
                                [&](const Vector2d& p) { return (p - place).norm() < reach; });
           });
         }) > 0;
}

/// Lattice cells that give about the wished count, going by the mesh so far.
double expected_cells(const Quadrangulation& quads, double spacing, int wished) {
  double on_chains = 0;
  for (const FeatureChain& chain : quads.chains.chains) on_chains += 1 + chain.length / spacing;
  const double share = on_chains / (wished / 4.0);
  return quads.lattice_cells * wished / quads.mesh.quad_count() /
         (kGradingGain + kChainGain * share);
}

}  // namespace

void refine_by_error(Quadrangulation& quads, const Raster& picture, const Raster& fitted,
                     const VectorizeOptions& options, const RunContext& context) {
  const bool whole = quads.outline.empty();
  const Raster& shown = whole ? picture : quads.inside;
  if (fitted.width != shown.width || fitted.height != shown.height) {
    throw Error(ErrorCode::invalid_argument, "the fitted picture differs from the picture in size");
  }
  if (quads.fallback || quads.scale.along_x.data.empty()) return;  // a lattice
  StageClock clock(context);
  FieldGrid<float> error = squared_error(shown, fitted);
  const double edge = 2 * std::sqrt(region_area(quads.outline, picture) / options.quads);
  if (whole && options.chain_share > 0 && options.tears.mode != TearOptions::Mode::off) {
    quads.chains = feature_chains(shown, options.chains, context);
    keep_worthwhile(quads.chains, error, edge, options.quads / 4.0, options.least_chain_gain);
    shed_weak_chains(quads.chains, edge, options.chain_share * options.quads / 4);
    clock.finish("chains", {{"chains", static_cast<double>(quads.chains.chains.size())}});
  }
  CountWish wish;
  wish.density = with_opencv_errors([&] { return error_density(quads, error); });
  const FieldGrid<float> map = wished_density(quads, options);
  for (std::size_t i = 0; i < map.data.size(); ++i) wish.density.data[i] *= map.data[i];
  clock.finish("error");
  wish.first_guess = expected_cells(quads, edge, options.quads);
  const QuadMesh before = quads.mesh;
  for (int round = 0; round < kMeshRounds; ++round) {
    mesh_to_count(quads, picture, edge, options, wish, clock, context);
    const bool valid = is_valid(quads.mesh, quads.outline, picture);
    if (valid && !leave_out_bad_chains(quads, edge)) break;
    if (!valid && quads.chains.chains.empty()) wish.density = map;
    if (!valid || round + 2 == kMeshRounds) quads.chains = {};
  }
  if (!is_valid(quads.mesh, quads.outline, picture)) quads.mesh = before;
  snap_to_features(quads.mesh, shown, options.snap, context);
  clock.finish("snapping");
}

}  // namespace quadrille
