#include "quadrille/feature_chains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "boundary_graph.h"
#include "chain_network.h"
#include "chain_rungs.h"
#include "chain_separation.h"
#include "chain_tracing.h"
#include "option_checks.h"
#include "parallel.h"
#include "premultiplied_colours.h"
#include "quadrille/error.h"
#include "watershed.h"

namespace quadrille {
namespace {

// Cells of half a pixel keep both sides of thin lines apart, up to so many pixels.
constexpr long long kFinePixels = 4'000'000;
constexpr float kLevelsPerUnit = 255;      // of the gradient, for the watershed
constexpr double kLeastSeparation = 0.8;   // pixels
constexpr double kLeastDepth = 0.5;        // of a basin, of the pass out of it
constexpr double kSidesPerPixel = 1.2;     // of a staircase, per length; a mean over directions
constexpr double kLongestMinLength = 1e9;  // far more than a picture's edges, and countable
constexpr float kNoise = 0.02f;            // gradients below it, per pixel, count as flat

/// Norm of the differences over a pixel at the centres of the cells, per pixel, each a mean over
/// half a pixel on either side (Sobel's), without which it undulates along oblique edges.
FieldGrid<float> gradient_norm(const PremultipliedColours& colours, int cells_per_pixel,
                               const RunContext& context) {
  using Colour = PremultipliedColours::Colour;
  constexpr int kBand = 16;  // rows
  FieldGrid<float> gradient(colours.width() * cells_per_pixel, colours.height() * cells_per_pixel);
  // The colours that neighbouring differences share lie on a lattice of half a pixel.
  const int step = 2 / cells_per_pixel;
  const auto place = [&](int i) { return 0.5 * i + 0.5 / cells_per_pixel - 0.5; };
  const auto fill_band = [&](int band) {
    std::array<std::vector<Colour>, 3> rows;  // of the lattice, row i at i % 3
    const auto fill_row = [&](int j) {
      std::vector<Colour>& row = rows[j % 3];
      row.resize(static_cast<std::size_t>(step) * (gradient.width - 1) + 3);
      for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = colours.at({place(static_cast<int>(i)), place(j)});
      }
    };
    const int begin = band * kBand, end = std::min(begin + kBand, gradient.height);
    int filled = step * begin;
    for (int y = begin; y < end; ++y) {
      for (; filled < step * y + 3; ++filled) fill_row(filled);
      const Colour* const above = rows[step * y % 3].data();
      const Colour* const here = rows[(step * y + 1) % 3].data();
      const Colour* const below = rows[(step * y + 2) % 3].data();
      for (int x = 0; x < gradient.width; ++x) {
        const int l = step * x, m = l + 1, r = l + 2;
        const Colour dx = (above[r] - above[l]) + 2 * (here[r] - here[l]) + (below[r] - below[l]);
        const Colour dy = (below[l] - above[l]) + 2 * (below[m] - above[m]) + (below[r] - above[r]);
        gradient(x, y) = 0.25f * std::sqrt(dx.squaredNorm() + dy.squaredNorm());
      }
    }
  };
  parallel_rows(context, (gradient.height + kBand - 1) / kBand, kBand * gradient.width, fill_band);
  return gradient;
}

FieldGrid<unsigned char> levels(const FieldGrid<float>& gradient) {
  FieldGrid<unsigned char> level(gradient.width, gradient.height);
  for (std::size_t i = 0; i < level.data.size(); ++i) {
    const float excess = std::max(0.0f, gradient.data[i] - kNoise);
    level.data[i] = static_cast<unsigned char>(std::min(255.0f, excess * kLevelsPerUnit));
  }
  return level;
}

}  // namespace

void check_options(const ChainOptions& options) {
  const auto is_good = [](double v) { return v > 0 && std::isfinite(v); };
  if (!is_good(options.contrast) || !is_good(options.weak_contrast) ||
      !(options.sharpness >= 0 && options.sharpness <= 1) ||
      !(options.min_length >= 0 && options.min_length <= kLongestMinLength)) {
    throw Error(ErrorCode::invalid_argument,
                "feature chains need positive contrasts, a sharpness between 0 and 1, and a "
                "length from 0 to 1e9 pixels");
  }
}

ChainNetwork feature_chains(const Raster& picture, const ChainOptions& options,
                            const RunContext& context) {
  check_raster(picture);
  check_options(options);
  context.progress("chains", 0);
  const int fineness = 1LL * picture.width * picture.height <= kFinePixels ? 2 : 1;
  const PremultipliedColours colours(picture);
  const FieldGrid<float> gradient = gradient_norm(colours, fineness, context);
  context.progress("chains", 0.3);
  const FieldGrid<unsigned char> height = levels(gradient);
  const double cell = 1.0 / fineness;
  BoundaryGraph lines =
      boundary_graph(merge_shallow_basins(height, catchment_basins(height), kLeastDepth));
  leave_out_rungs(lines, colours, gradient, cell, options.contrast);
  BoundaryGraph graph = strong_runs(colours, lines, gradient, cell, options, context);
  context.progress("chains", 0.7);
  std::vector<Eigen::Vector2d> places;
  std::vector<char> is_on_border;
  for (const Eigen::Vector2i& node : graph.nodes) {
    places.push_back(node.cast<double>() * cell);
    is_on_border.push_back(node.x() == 0 || node.y() == 0 || node.x() == gradient.width ||
                           node.y() == gradient.height);
  }
  simplify(graph, static_cast<std::size_t>(options.min_length * kSidesPerPixel * fineness),
           is_on_border);
  ChainNetwork network = chain_network(traced_chains(colours, graph, cell, context), places,
                                       picture.width, picture.height);
  separate_chains(network, kLeastSeparation, options.min_length);
  return network;
}

void shed_weak_chains(ChainNetwork& network, double spacing, double vertices) {
  std::vector<FeatureChain>& chains = network.chains;
  std::stable_sort(chains.begin(), chains.end(),
                   [](const FeatureChain& a, const FeatureChain& b) { return a.gain > b.gain; });
  double count = 0;
  const auto rest = std::find_if(chains.begin(), chains.end(), [&](const FeatureChain& chain) {
    count += 1 + chain.length / spacing;
    return count > vertices;
  });
  chains.erase(rest, chains.end());
  std::vector<int> number(network.nodes.size(), -1);
  std::vector<Eigen::Vector2d> nodes;
  for (FeatureChain& chain : chains) {
    for (int* node : {&chain.from, &chain.to}) {
      if (number[*node] < 0) {
        number[*node] = static_cast<int>(nodes.size());
        nodes.push_back(network.nodes[*node]);
      }
      *node = number[*node];
    }
  }
  network.nodes = std::move(nodes);
}

}  // namespace quadrille
