#include "quadrille/tears.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "fitted_state.h"
#include "parallel_ranges.h"
#include "patch_scan.h"
#include "picture_sampling.h"
#include "quadrille/error.h"
#include "quadrille/patch_geometry.h"
#include "quadrille/remove_duplicates.h"

namespace quadrille {
namespace {

/// Differences below half a step of 8 bits are worth nothing.
constexpr double kInvisible = 0.25 / 255 / 255;
/// The error of a jump reaches this far into the quads beside it when it cannot be torn, in quads.
constexpr int kReach = 4;
/// A chain whose drop per edge is below this share of a neighbour's waits until that one is torn.
constexpr double kStrongShare = 0.25;
constexpr int kRounds = 4;

void check(const QuadMesh& mesh, const std::vector<std::vector<int>>& chains) {
  for (const std::vector<int>& chain : chains) {
    for (const int e : chain) {
      if (e >= 0 && e < mesh.edge_count()) continue;
      throw Error(ErrorCode::invalid_argument, "a chain to tear names edge " + std::to_string(e) +
                                                   " of " + std::to_string(mesh.edge_count()) +
                                                   "; give edges of the mesh");
    }
  }
}

/// The mesh with all chains marked as features, and those with a flag torn.
QuadMesh with_chains(const QuadMesh& mesh, const std::vector<std::vector<int>>& chains,
                     const std::vector<char>& is_torn) {
  QuadMesh result = mesh;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    for (const int e : chains[c]) {
      result.edge_flags[e] |= kFeatureEdge | (is_torn[c] ? kTearEdge : 0);
    }
  }
  return result;
}

/// How the picture is fitted when some of the chains are torn.
struct Trial {
  PatchMesh patches;
  std::vector<float> errors;  // #pixels, squared and summed over the channels

  /// Geometry from `tangents`; its samples are left for the next trial.
  Trial(QuadMesh mesh, const std::vector<std::array<Eigen::Vector2d, 2>>& tangents,
        const Raster& picture, const FitOptions& fit, const RunContext& context,
        std::vector<SampleBlock>& samples)
      : patches(straight_patches(std::move(mesh))) {
    patches.edge_tangents = tangents;
    fit_colors(patches, picture, {.method = FitMethod::bessel}, context);
    FittedState state(std::move(patches), picture, fit, context, std::move(samples));
    patches = std::move(state.patches);
    samples = std::move(state.samples);
    errors.reserve(static_cast<std::size_t>(picture.width) * picture.height);
    for (std::size_t i = 0; i < errors.capacity(); ++i) {
      errors.push_back(state.squared_error_at(picture, i));
    }
  }
};

std::vector<std::array<Eigen::Vector2d, 2>> smooth_tangents(const QuadMesh& mesh) {
  PatchMesh patches = straight_patches(mesh);
  set_bessel_tangents(patches);
  guard_folds(patches);
  return patches.edge_tangents;
}

/// Number of wedges per vertex.
std::vector<int> wedge_counts(const PatchMesh& patches) {
  std::vector<int> count(patches.mesh.vertex_count(), 0);
  std::vector<char> seen(patches.wedges.size(), 0);
  for (int h = 0; h < patches.mesh.halfedge_count(); ++h) {
    if (!std::exchange(seen[patches.wedge_of_corner[h]], 1)) ++count[patches.mesh.origin(h)];
  }
  return count;
}

/// The surroundings of the chains.
class Neighbourhoods {
 public:
  Neighbourhoods(const QuadMesh& mesh, const std::vector<std::vector<int>>& chains) : mesh_(mesh) {
    for (const std::vector<int>& chain : chains) {
      std::vector<int>& vertices = vertices_.emplace_back();
      for (const int e : chain) {
        if (mesh.is_border(e)) continue;
        const int h = mesh.halfedge(e);
        vertices.push_back(mesh.origin(h));
        vertices.push_back(mesh.tip(h));
      }
      remove_duplicates(vertices);
    }
  }

  const std::vector<int>& vertices(std::size_t chain) const { return vertices_[chain]; }

  /// The quads that touch the chain, ascending.
  std::vector<int> quads(std::size_t chain) const { return quads_at(mesh_, vertices_[chain]); }

  /// Per chain the others within kReach quads.
  std::vector<std::vector<int>> neighbours() const {
    std::vector<std::vector<int>> chains_at(mesh_.vertex_count());
    for (std::size_t c = 0; c < vertices_.size(); ++c) {
      for (const int v : vertices_[c]) chains_at[v].push_back(static_cast<int>(c));
    }
    std::vector<std::vector<int>> found(vertices_.size());
    for (std::size_t c = 0; c < vertices_.size(); ++c) {
      std::vector<int> reached = vertices_[c];
      for (int ring = 0; ring < kReach; ++ring) {
        reached = corners_of(mesh_, quads_at(mesh_, reached));
      }
      for (const int v : reached) {
        found[c].insert(found[c].end(), chains_at[v].begin(), chains_at[v].end());
      }
      remove_duplicates(found[c]);
      std::erase(found[c], static_cast<int>(c));
    }
    return found;
  }

 private:
  const QuadMesh& mesh_;
  std::vector<std::vector<int>> vertices_;
};

/// Compares trials chain by chain with the one in which all are torn.
class Judge {
 public:
  Judge(const Neighbourhoods& near, const Trial& all, const Raster& picture,
        const TearOptions& options)
      : near_(near),
        all_(all),
        scan_(all.patches, SampleGrid{}),
        size_{0, 0, picture.width, picture.height},
        channels_(picture.channels),
        options_(options),
        all_wedges_(wedge_counts(all.patches)) {}

  /// How much the squared error falls when the chain is torn too; 0 when that does not pay.
  double drop(std::size_t chain, const Trial& before, const std::vector<int>& wedges_before) const {
    int added_wedges = 0;
    for (const int v : near_.vertices(chain)) added_wedges += all_wedges_[v] - wedges_before[v];
    if (added_wedges <= 0) return 0;
    double whole = 0, torn = 0, values = 0;
    for (const int q : near_.quads(chain)) {
      scan_.scan(q, intersection(scan_.bounds(q), size_), [&](int y, int x_begin, int x_end) {
        for (int x = x_begin; x < x_end; ++x) {
          const std::size_t i = static_cast<std::size_t>(y) * size_.x_end + x;
          whole += before.errors[i];
          torn += all_.errors[i];
          values += channels_;
        }
      });
    }
    const double variance = (values > 0 ? torn / values : 0) + kInvisible;
    const double numbers = 4.0 * channels_ * added_wedges;
    const double least =
        std::max(options_.relative_drop * whole, options_.price * numbers * variance);
    return whole - torn > least ? whole - torn : 0;
  }

 private:
  const Neighbourhoods& near_;
  const Trial& all_;
  PatchScan scan_;
  SampleWindow size_;
  int channels_;
  const TearOptions& options_;
  std::vector<int> all_wedges_;
};

/// Forward selection from none.
std::vector<char> paying_chains(const QuadMesh& mesh, const std::vector<std::vector<int>>& chains,
                                const Raster& picture, const FitOptions& draft,
                                const TearOptions& options, const RunContext& context) {
  std::vector<char> is_torn(chains.size(), 0);
  const QuadMesh everything = with_chains(mesh, chains, std::vector<char>(chains.size(), 1));
  const auto tangents = smooth_tangents(everything);
  std::vector<SampleBlock> samples;
  const Trial all(everything, tangents, picture, draft, context, samples);
  const Neighbourhoods near(all.patches.mesh, chains);
  const auto neighbours = near.neighbours();
  const Judge judge(near, all, picture, options);
  for (int round = 0; round < kRounds; ++round) {
    const Trial now(with_chains(mesh, chains, is_torn), tangents, picture, draft, context, samples);
    const std::vector<int> wedges = wedge_counts(now.patches);
    std::vector<double> drop(chains.size(), 0);  // per edge
    for (std::size_t c = 0; c < chains.size(); ++c) {
      const double edges = std::max(1.0, static_cast<double>(chains[c].size()));
      if (!is_torn[c]) drop[c] = judge.drop(c, now, wedges) / edges;
    }
    bool is_waiting = false;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      if (!(drop[c] > 0)) continue;
      const bool is_strong = std::all_of(neighbours[c].begin(), neighbours[c].end(),
                                         [&](int n) { return drop[c] >= kStrongShare * drop[n]; });
      if (is_strong || round + 1 == kRounds) {
        is_torn[c] = 1;
      } else {
        is_waiting = true;
      }
    }
    if (!is_waiting) break;
  }
  return is_torn;
}

}  // namespace

void check_options(const TearOptions& options) {
  const auto reject = [](const std::string& message) {
    throw Error(ErrorCode::invalid_argument, message);
  };
  if (!(options.relative_drop >= 0 && options.relative_drop <= 1)) {
    reject("the relative drop asked of a tear is " + std::to_string(options.relative_drop) +
           "; use a share between 0 and 1 such as 0.1");
  }
  if (!(options.price >= 0) || !std::isfinite(options.price)) {
    reject("the price of a tear's numbers is " + std::to_string(options.price) +
           "; use a number from 0 up such as 6");
  }
}

std::vector<char> judge_tears(const QuadMesh& mesh, const std::vector<std::vector<int>>& chains,
                              const Raster& picture, const FitOptions& fit,
                              const TearOptions& options, const RunContext& context) {
  check_options(options);
  check(mesh, chains);
  const bool strong = options.mode == TearOptions::Mode::strong;
  std::vector<char> is_torn(chains.size(), strong);
  if (options.mode != TearOptions::Mode::automatic || chains.empty()) return is_torn;
  tbb::task_arena arena(arena_size(context));
  arena.execute([&] {
    is_torn = paying_chains(mesh, chains, picture, draft_options(fit), options, context);
  });
  return is_torn;
}

}  // namespace quadrille
