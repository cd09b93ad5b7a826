#include "chain_sampling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "arc_division.h"
#include "chain_curve.h"
#include "curve_index.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kReach = 0.35;      // of lattice points to the chain, in spacings
constexpr double kClearance = 0.25;  // of other lattice points from the chain, in spacings
constexpr double kClosest = 0.5;     // least distance between samples along the chain, in spacings
constexpr ArcTolerance kTolerance = {.most_bulge = 0.2,
                                     .distance = 0.25,
                                     .coarse_distance = 0.02,
                                     .shortest = 3,
                                     .coarse_shortest = 0.35};

/// The samples of one chain, by arc length, without its ends.
class ChainSampler {
 public:
  ChainSampler(const FeatureChain& chain, const DirectedSpacing& spacing)
      : curve_(chain.points), spacing_(spacing), places_{0.0, curve_.length()} {}

  const ChainCurve& curve() const { return curve_; }
  const std::vector<double>& places() const { return places_; }

  /// A sample for a lattice point at s, or the one nearby.
  double take(double s, double spacing) {
    const auto after = std::lower_bound(places_.begin(), places_.end(), s);
    std::optional<double> nearby;
    double distance = kClosest * spacing;
    const auto consider = [&](double place) {
      if (std::abs(place - s) < distance) nearby = place, distance = std::abs(place - s);
    };
    if (after != places_.end()) consider(*after);
    if (after != places_.begin()) consider(*std::prev(after));
    if (!nearby) places_.insert(after, s);
    return nearby.value_or(s);
  }

  void fill_gaps() {
    std::vector<double> all = {0.0};
    const auto is_good = [&](double from, double to) {
      return follows_arc([&](double s) { return curve_.at(s); }, from, to,
                         spacing_between(from, to), kTolerance);
    };
    for (std::size_t i = 1; i < places_.size(); ++i) {
      const double from = places_[i - 1], whole = places_[i] - from;
      const int parts = edge_count(whole, [&](double t0, double t1) {
        return spacing_between(from + whole * t0, from + whole * t1);
      });
      for (int k = 0; k < parts; ++k) {
        const double end = k + 1 == parts ? places_[i] : from + whole * (k + 1) / parts;
        halve_arc(from + whole * k / parts, end, is_good, [&](double s) { all.push_back(s); });
        all.push_back(end);
      }
    }
    places_ = std::move(all);
  }

 private:
  ChainCurve curve_;
  const DirectedSpacing& spacing_;
  std::vector<double> places_;

  double spacing_between(double from, double to) const {
    return spacing_(curve_.at(0.5 * (from + to)), curve_.direction(from, to));
  }
};

CurveIndex index_of(const ChainNetwork& network, double cell) {
  std::vector<CurveSegment> segments;
  for (int c = 0; c < static_cast<int>(network.chains.size()); ++c) {
    const std::vector<Vector2d>& p = network.chains[c].points;
    const std::vector<double> s = arc_lengths(p);
    for (std::size_t i = 1; i < p.size(); ++i) segments.push_back({c, p[i - 1], p[i], s[i - 1]});
  }
  return CurveIndex(std::move(segments), cell);
}

/// What takes the place of a lattice point: the place s on a chain, or one of the constants.
struct SampleKey {
  int chain = kNoSample;
  double s = 0;
};

/// Takes the lattice points near the chains as samples of them.
std::vector<SampleKey> take_lattice_points(std::vector<ChainSampler>& samplers,
                                           const CurveIndex& index, const LatticeGraph& graph,
                                           double width, double height) {
  std::vector<SampleKey> keys(graph.points.size());
  const auto is_on_border = [&](const Vector2d& p) {
    return p.x() <= 0 || p.y() <= 0 || p.x() >= width || p.y() >= height;
  };
  for (std::size_t p = 0; p < graph.points.size(); ++p) {
    const auto place = index.nearest(graph.points[p], kReach * graph.spacing[p]);
    if (!place) continue;
    ChainSampler& sampler = samplers[place->curve];
    if (!is_on_border(graph.points[p])) {
      keys[p] = {place->curve, sampler.take(place->s, graph.spacing[p])};
      continue;
    }
    // Points of the picture's border may only become nodes on it.
    const double end = place->s < 0.5 * sampler.curve().length() ? 0 : sampler.curve().length();
    if (is_on_border(sampler.curve().at(end)) &&
        std::abs(end - place->s) < kClosest * graph.spacing[p]) {
      keys[p] = {place->curve, end};
    } else if (place->distance < kClearance * graph.spacing[p]) {
      keys[p].chain = kInTheWay;
    }
  }
  return keys;
}

/// Fills the samples' gaps, lists points and pieces, and says which point each place of a chain is.
std::vector<std::map<double, int>> list_samples(const ChainNetwork& network,
                                                std::vector<ChainSampler>& samplers,
                                                ChainSamples& samples) {
  samples.points = network.nodes;
  std::vector<std::map<double, int>> sample_at(samplers.size());
  for (int c = 0; c < static_cast<int>(samplers.size()); ++c) {
    samplers[c].fill_gaps();
    const FeatureChain& chain = network.chains[c];
    const std::vector<double>& places = samplers[c].places();
    int a = chain.from;
    sample_at[c][places.front()] = a;
    for (std::size_t i = 1; i < places.size(); ++i) {
      int b = chain.to;
      if (i + 1 < places.size()) {
        b = static_cast<int>(samples.points.size());
        samples.points.push_back(samplers[c].curve().at(places[i]));
      }
      sample_at[c][places[i]] = b;
      samples.pieces.push_back({c, places[i - 1], places[i], a, b});
      a = b;
    }
  }
  samples.neighbours.resize(samples.points.size());
  for (const ChainSamples::Piece& piece : samples.pieces) {
    samples.neighbours[piece.a].push_back(piece.b);
    samples.neighbours[piece.b].push_back(piece.a);
  }
  return sample_at;
}

}  // namespace

bool ChainSamples::is_ear(int a, int b) const {
  constexpr int kSteps = 3;
  std::vector<int> reached = {a};
  std::size_t begin = 0;
  for (int step = 0; step < kSteps; ++step) {
    const std::size_t end = reached.size();
    for (; begin < end; ++begin) {
      for (const int n : neighbours[reached[begin]]) {
        if (n == b) return true;
        reached.push_back(n);
      }
    }
  }
  return false;
}

DirectedSpacing directed_spacing(const CrossField& field, const ScaleField& scale, double scale_x,
                                 double scale_y) {
  return [&field, &scale, scale_x, scale_y](const Vector2d& p, const Vector2d& direction) {
    const int x = std::clamp(static_cast<int>(p.x() / scale_x), 0, field.z.width - 1);
    const int y = std::clamp(static_cast<int>(p.y() / scale_y), 0, field.z.height - 1);
    const double turn = std::atan2(direction.y(), direction.x()) - field.angle(x, y);
    const double along = std::cos(turn) / scale.along_x(x, y);
    const double across = std::sin(turn) / scale.along_y(x, y);
    return std::sqrt(scale_x * scale_y) / std::hypot(along, across);
  };
}

ChainSamples sample_chains(const ChainNetwork& network, const LatticeGraph& graph,
                           const DirectedSpacing& spacing, double width, double height) {
  std::vector<ChainSampler> samplers;
  for (const FeatureChain& chain : network.chains) samplers.emplace_back(chain, spacing);
  const double mean_spacing =
      std::accumulate(graph.spacing.begin(), graph.spacing.end(), 0.0) / graph.spacing.size();
  const CurveIndex index = index_of(network, std::max(2.0, mean_spacing));
  const std::vector<SampleKey> keys = take_lattice_points(samplers, index, graph, width, height);
  ChainSamples samples;
  const std::vector<std::map<double, int>> sample_at = list_samples(network, samplers, samples);
  for (const SampleKey& key : keys) {
    samples.sample_of_lattice_point.push_back(key.chain < 0 ? key.chain
                                                            : sample_at[key.chain].at(key.s));
  }
  return samples;
}

}  // namespace quadrille
