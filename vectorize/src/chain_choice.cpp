#include "chain_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kWorstCorner = 0.18;  // sine; chains that lead to worse ones are not followed

}  // namespace

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

}  // namespace quadrille
