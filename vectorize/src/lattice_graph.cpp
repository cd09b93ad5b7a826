#include "lattice_graph.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lattice_shift.h"
#include "quadrille/disjoint_sets.h"

namespace quadrille {
namespace {

constexpr float kFeatureEmphasis = 8;    // weight of a pixel on a feature line beside others' 1
constexpr double kFragmentShare = 0.12;  // regions below this share of a lattice cell are noise
constexpr double kBorderReach = 0.35;    // points nearer to a side, in spacings, move onto it
constexpr float kWidestRegion = 1.0f;    // distance of lattice points in a region, in spacings
constexpr double kWidestGap = 3.2;  // between points on a side, in spacings of the shorter axis
constexpr double kClosest = 0.5;    // least distance between points, in spacings

/// Shift from each pixel to its right and lower neighbour.
struct Shifts {
  FieldGrid<Eigen::Vector2i> right, down;
};

Shifts neighbour_shifts(const CrossField& field, const ScaleField& scale,
                        const PositionField& positions) {
  const int w = field.z.width, h = field.z.height;
  Shifts shifts{FieldGrid<Eigen::Vector2i>(w, h, Eigen::Vector2i::Zero()),
                FieldGrid<Eigen::Vector2i>(w, h, Eigen::Vector2i::Zero())};
  FieldGrid<LatticePoint> points(w, h);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      points(x, y) = {static_cast<float>(field.angle(x, y)),
                      {scale.along_x(x, y), scale.along_y(x, y)},
                      positions.origin(x, y)};
    }
  }
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      if (x + 1 < w) shifts.right(x, y) = shift_between(points(x, y), points(x + 1, y));
      if (y + 1 < h) shifts.down(x, y) = shift_between(points(x, y), points(x, y + 1));
    }
  }
  return shifts;
}

/// Numbers the regions in the order of their first pixels.
FieldGrid<int> label_regions(const Shifts& shifts, int& count) {
  const int w = shifts.right.width, h = shifts.right.height;
  DisjointSets sets(static_cast<std::size_t>(w) * h);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const int i = y * w + x;
      if (x + 1 < w && shifts.right(x, y).isZero()) sets.unite(i, i + 1);
      if (y + 1 < h && shifts.down(x, y).isZero()) sets.unite(i, i + w);
    }
  }
  FieldGrid<int> labels(w, h, -1);
  count = 0;
  for (std::size_t i = 0; i < labels.data.size(); ++i) {
    const int root = sets.find(static_cast<int>(i));
    if (labels.data[root] < 0) labels.data[root] = count++;
    labels.data[i] = labels.data[root];
  }
  return labels;
}

struct Region {
  Eigen::Vector2d origin_sum = Eigen::Vector2d::Zero();
  double weight = 0;
  double spacing_sum = 0;
  double cell_share = 0;  // of a whole lattice cell
  int pixels = 0;
};

std::vector<Region> measure_regions(const FieldGrid<int>& labels, int count,
                                    const FeatureTensor& features, const ScaleField& scale,
                                    const PositionField& positions) {
  std::vector<Region> regions(count);
  for (std::size_t i = 0; i < labels.data.size(); ++i) {
    Region& region = regions[labels.data[i]];
    const double weight =
        1 + (features.edges.data[i] ? kFeatureEmphasis * features.weight.data[i] : 0.0f);
    region.origin_sum += weight * positions.origin.data[i].cast<double>();
    region.weight += weight;
    const double lx = scale.along_x.data[i], ly = scale.along_y.data[i];
    region.spacing_sum += std::min(lx, ly);
    region.cell_share += 1 / (lx * ly);
    ++region.pixels;
  }
  return regions;
}

/// Chains of small differences may unite pixels whose lattice points lie far apart. Divides such
/// regions into parts of pixels with lattice points near to each other.
void divide_wide_regions(FieldGrid<int>& labels, int& count, const ScaleField& scale,
                         const PositionField& positions) {
  struct Part {
    Eigen::Vector2f origin;
    int label;
  };
  std::vector<std::vector<Part>> parts(count);
  for (std::size_t i = 0; i < labels.data.size(); ++i) {
    const Eigen::Vector2f& origin = positions.origin.data[i];
    const float reach = kWidestRegion * std::min(scale.along_x.data[i], scale.along_y.data[i]);
    auto& known = parts[labels.data[i]];
    const auto near = std::ranges::find_if(
        known, [&](const Part& part) { return (part.origin - origin).norm() <= reach; });
    if (near != known.end()) {
      labels.data[i] = near->label;
      continue;
    }
    known.push_back({origin, known.empty() ? labels.data[i] : count++});
    labels.data[i] = known.back().label;
  }
}

/// Accepts points one by one, keeping a distance; finds the accepted point near a place.
class SpacedPoints {
 public:
  SpacedPoints(LatticeGraph& graph, double cell) : graph_(graph), cell_(cell) {}

  int nearest_within(const Eigen::Vector2d& p, double distance) const {
    int best = -1;
    double best_distance = distance * distance;
    const int reach = static_cast<int>(std::ceil(distance / cell_));
    const auto [cx, cy] = cell_of(p);
    for (int y = cy - reach; y <= cy + reach; ++y) {
      for (int x = cx - reach; x <= cx + reach; ++x) {
        const auto bucket = buckets_.find({x, y});
        if (bucket == buckets_.end()) continue;
        for (const int i : bucket->second) {
          const double d = (graph_.points[i] - p).squaredNorm();
          if (d < best_distance) best_distance = d, best = i;
        }
      }
    }
    return best;
  }

  int add(const Eigen::Vector2d& p, double spacing) {
    buckets_[cell_of(p)].push_back(static_cast<int>(graph_.points.size()));
    graph_.points.push_back(p);
    graph_.spacing.push_back(spacing);
    return static_cast<int>(graph_.points.size()) - 1;
  }

 private:
  std::array<int, 2> cell_of(const Eigen::Vector2d& p) const {
    return {static_cast<int>(std::floor(p.x() / cell_)),
            static_cast<int>(std::floor(p.y() / cell_))};
  }
  LatticeGraph& graph_;
  double cell_;
  std::map<std::array<int, 2>, std::vector<int>> buckets_;
};

/// How many of its coordinates a side of the picture holds: 2 at a corner, 0 inside.
int hold(Eigen::Vector2d& p, double reach, double width, double height) {
  int held = 0;
  const double size[2] = {width, height};
  for (int axis = 0; axis < 2; ++axis) {
    if (p[axis] < reach) {
      p[axis] = 0, ++held;
    } else if (p[axis] > size[axis] - reach) {
      p[axis] = size[axis], ++held;
    }
  }
  return held;
}

/// Turns regions into points; returns the point of each region, -1 for fragments.
std::vector<int> place_points(const std::vector<Region>& regions, double width, double height,
                              LatticeGraph& graph) {
  struct Candidate {
    int region, held;
    Eigen::Vector2d position;
    double spacing;
  };
  std::vector<Candidate> candidates;
  double mean_spacing = 0;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Region& region = regions[r];
    const double spacing = region.spacing_sum / region.pixels;
    Eigen::Vector2d p = region.origin_sum / region.weight;
    const int held = hold(p, kBorderReach * spacing, width, height);
    const double whole_cell = held == 2 ? 0.25 : held == 1 ? 0.5 : 1;
    if (region.cell_share < kFragmentShare * whole_cell) continue;
    candidates.push_back({static_cast<int>(r), held, p, spacing});
    mean_spacing += spacing;
  }
  std::stable_sort(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) {
    if (a.held != b.held) return a.held > b.held;
    return regions[a.region].cell_share > regions[b.region].cell_share;
  });
  mean_spacing = candidates.empty() ? 1 : mean_spacing / candidates.size();

  SpacedPoints spaced(graph, mean_spacing);
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(width, 0), Eigen::Vector2d(width, height),
        Eigen::Vector2d(0, height)}) {
    spaced.add(corner, mean_spacing);
  }
  std::vector<int> point_of(regions.size(), -1);
  for (const Candidate& c : candidates) {
    const int near = spaced.nearest_within(c.position, kClosest * c.spacing);
    point_of[c.region] = near >= 0 ? near : spaced.add(c.position, c.spacing);
  }
  return point_of;
}

/// Where the lattice beside a side is broken into fragments, points may be missing there: adds them
/// at the spacing of the ends of each gap.
void fill_gaps_of_sides(double width, double height, LatticeGraph& graph) {
  const double size[2] = {width, height};
  for (int side = 0; side < 4; ++side) {
    const int along = side & 1, across = 1 - along;
    const double at = side < 2 ? 0 : size[across];
    std::vector<int> on_side;
    for (int i = 0; i < static_cast<int>(graph.points.size()); ++i) {
      if (graph.points[i][across] == at) on_side.push_back(i);
    }
    std::ranges::sort(on_side, {}, [&](int i) { return graph.points[i][along]; });
    for (std::size_t k = 0; k + 1 < on_side.size(); ++k) {
      const int a = on_side[k], b = on_side[k + 1];
      const double gap = graph.points[b][along] - graph.points[a][along];
      const double spacing = 0.5 * (graph.spacing[a] + graph.spacing[b]);
      if (gap <= kWidestGap * spacing) continue;
      const int parts = static_cast<int>(std::lround(gap / spacing));
      for (int j = 1; j < parts; ++j) {
        const double share = static_cast<double>(j) / parts;
        graph.points.push_back((1 - share) * graph.points[a] + share * graph.points[b]);
        graph.spacing.push_back(spacing);
      }
    }
  }
}

struct Contact {
  std::array<int, 2> points;
  bool is_edge;
};

std::vector<std::array<int, 2>> lattice_edges(const FieldGrid<int>& labels, const Shifts& shifts,
                                              const std::vector<int>& point_of) {
  std::vector<Contact> contacts;
  const auto touch = [&](int a, int b, const Eigen::Vector2i& shift) {
    const int p = point_of[a], q = point_of[b];
    if (p < 0 || q < 0 || p == q) return;
    contacts.push_back({{std::min(p, q), std::max(p, q)}, shift.cwiseAbs().sum() == 1});
  };
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      if (x + 1 < labels.width) touch(labels(x, y), labels(x + 1, y), shifts.right(x, y));
      if (y + 1 < labels.height) touch(labels(x, y), labels(x, y + 1), shifts.down(x, y));
    }
  }
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const Contact& a, const Contact& b) { return a.points < b.points; });
  struct Counted {
    int votes;
    std::array<int, 2> points;
  };
  std::vector<Counted> counted;
  for (std::size_t i = 0; i < contacts.size();) {
    int votes = 0;
    std::size_t j = i;
    for (; j < contacts.size() && contacts[j].points == contacts[i].points; ++j) {
      votes += contacts[j].is_edge ? 1 : -1;
    }
    if (votes > 0) counted.push_back({votes, contacts[i].points});
    i = j;
  }
  std::stable_sort(counted.begin(), counted.end(),
                   [](const Counted& a, const Counted& b) { return a.votes > b.votes; });
  std::vector<std::array<int, 2>> edges;
  for (const Counted& c : counted) edges.push_back(c.points);
  return edges;
}

}  // namespace

LatticeGraph lattice_graph(const FeatureTensor& features, const CrossField& field,
                           const ScaleField& scale, const PositionField& positions) {
  const Shifts shifts = neighbour_shifts(field, scale, positions);
  int count = 0;
  FieldGrid<int> labels = label_regions(shifts, count);
  divide_wide_regions(labels, count, scale, positions);
  const std::vector<Region> regions = measure_regions(labels, count, features, scale, positions);
  LatticeGraph graph;
  const std::vector<int> point_of = place_points(regions, field.z.width, field.z.height, graph);
  fill_gaps_of_sides(field.z.width, field.z.height, graph);
  graph.edges = lattice_edges(labels, shifts, point_of);
  return graph;
}

LatticeGraph scaled(LatticeGraph graph, double scale_x, double scale_y) {
  for (Eigen::Vector2d& p : graph.points) p = {p.x() * scale_x, p.y() * scale_y};
  for (double& s : graph.spacing) s *= std::sqrt(scale_x * scale_y);
  return graph;
}

double units_per_pixel(const LatticeGraph& graph, double width, double height) {
  constexpr double kUnitsPerSpacing = 512;
  constexpr double kLeast = 64, kMostUnits = 1 << 29;
  const double least = *std::min_element(graph.spacing.begin(), graph.spacing.end());
  const double longest = std::max(width, height);
  double units = kLeast;
  while (units * least < kUnitsPerSpacing && 2 * units * longest <= kMostUnits) units *= 2;
  return units;
}

}  // namespace quadrille
