#include "chain_sampling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "curve_index.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kReach = 0.35;      // of lattice points to the chain, in spacings
constexpr double kClearance = 0.25;  // of other lattice points from the chain, in spacings
constexpr double kClosest = 0.5;     // least distance between samples along the chain, in spacings
// A piece is divided where the curve leaves the parabola through its ends and its middle by more
// than this many pixels or spacings,
constexpr double kTolerance = 0.25, kCoarseTolerance = 0.02;
// or turns by more than this share of its length away from its chord, but not below this length.
constexpr double kMostBulge = 0.2;
constexpr double kShortest = 3, kCoarseShortest = 0.35;

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
    double best = s, distance = kClosest * spacing;
    const auto consider = [&](double place) {
      if (std::abs(place - s) < distance) best = place, distance = std::abs(place - s);
    };
    if (after != places_.end()) consider(*after);
    if (after != places_.begin()) consider(*std::prev(after));
    if (best == s) places_.insert(after, s);
    return best;
  }

  void fill_gaps() {
    std::vector<double> all = {0.0};
    for (std::size_t i = 1; i < places_.size(); ++i) {
      const double from = places_[i - 1], whole = places_[i] - from;
      constexpr int kSteps = 16;
      double edges = 0;
      for (int k = 0; k < kSteps; ++k) {
        edges += whole / kSteps /
                 spacing_between(from + whole * k / kSteps, from + whole * (k + 1) / kSteps);
      }
      const int parts = std::max(1, static_cast<int>(std::lround(std::min(edges, 1e6))));
      for (int k = 0; k < parts; ++k) {
        const double end = k + 1 == parts ? places_[i] : from + whole * (k + 1) / parts;
        refine(from + whole * k / parts, end, all);
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

  /// Appends the places after `from` up to `to`.
  void refine(double from, double to, std::vector<double>& all) const {
    if (fits(from, to)) {
      all.push_back(to);
      return;
    }
    refine(from, 0.5 * (from + to), all);
    refine(0.5 * (from + to), to, all);
  }

  bool fits(double from, double to) const {
    const double arc = to - from;
    const double spacing = spacing_between(from, to);
    if (arc < std::max(kShortest, kCoarseShortest * spacing)) return true;
    const Vector2d a = curve_.at(from), b = curve_.at(to);
    const Vector2d chord = b - a, bulge = curve_.at(0.5 * (from + to)) - 0.5 * (a + b);
    const double tolerance = std::max(kTolerance, kCoarseTolerance * spacing);
    if (bulge.norm() > std::max(kMostBulge * chord.norm(), 0.5 * tolerance)) return false;
    const int steps = std::clamp(static_cast<int>(arc), 4, 64);
    for (int k = 1; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const Vector2d parabola = a + t * chord + 4 * t * (1 - t) * bulge;
      if ((curve_.at(from + t * arc) - parabola).norm() > tolerance) return false;
    }
    return true;
  }
};

CurveIndex index_of(const ChainNetwork& network, double cell) {
  std::vector<CurveSegment> segments;
  for (int c = 0; c < static_cast<int>(network.chains.size()); ++c) {
    const std::vector<Vector2d>& p = network.chains[c].points;
    double s = 0;
    for (std::size_t i = 1; i < p.size(); ++i) {
      segments.push_back({c, p[i - 1], p[i], s});
      s += (p[i] - p[i - 1]).norm();
    }
  }
  return CurveIndex(std::move(segments), cell);
}

}  // namespace

ChainCurve::ChainCurve(const std::vector<Vector2d>& points) : points_(points), arc_{0.0} {
  for (std::size_t i = 1; i < points.size(); ++i) {
    arc_.push_back(arc_.back() + (points[i] - points[i - 1]).norm());
  }
}

Vector2d ChainCurve::at(double s) const {
  const auto after = std::upper_bound(arc_.begin(), arc_.end(), s);
  const std::size_t i = std::clamp<std::ptrdiff_t>(after - arc_.begin() - 1, 0,
                                                   static_cast<std::ptrdiff_t>(points_.size()) - 2);
  const double size = arc_[i + 1] - arc_[i];
  const double t = size > 0 ? std::clamp((s - arc_[i]) / size, 0.0, 1.0) : 0;
  return points_[i] + t * (points_[i + 1] - points_[i]);
}

Vector2d ChainCurve::direction(double from, double to) const {
  const Vector2d chord = at(to) - at(from);
  const double length = chord.norm();
  return length > 0 ? Vector2d(chord / length) : Vector2d(1, 0);
}

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

  struct Key {
    int chain = kNoSample;
    double s = 0;
  };
  std::vector<Key> keys(graph.points.size());
  const double mean_spacing =
      std::accumulate(graph.spacing.begin(), graph.spacing.end(), 0.0) / graph.spacing.size();
  const CurveIndex index = index_of(network, std::max(2.0, mean_spacing));
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

  ChainSamples samples;
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
  for (const Key& key : keys) {
    samples.sample_of_lattice_point.push_back(key.chain < 0 ? key.chain
                                                            : sample_at[key.chain].at(key.s));
  }
  return samples;
}

}  // namespace quadrille
