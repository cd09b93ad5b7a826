#include <cmath>
#include <utility>

#include "chain_choice.h"
#include "count_meshing.h"
#include "error_density.h"
#include "meshed_region.h"
#include "opencv_errors.h"
#include "option_checks.h"
#include "quadrille/alpha_outline.h"
#include "quadrille/error.h"
#include "quadrille/vectorize.h"

namespace quadrille {
namespace {

constexpr int kMeshRounds = 4;
// Quads per cell grow by as much where the mesh is graded by the error, and by so many times the
// share of the vertices that lie on chains, which stay apart where others merge; as measured.
constexpr double kGradingGain = 1.01, kChainGain = 1.2;

/// Lattice cells that give about the wished count, going by the mesh so far.
double expected_cells(const Quadrangulation& quads, double spacing, int wished) {
  double on_chains = 0;
  for (const FeatureChain& chain : quads.chains.chains) on_chains += 1 + chain.length / spacing;
  const double share = on_chains / (wished / 4.0);
  return quads.lattice_cells * wished / quads.mesh.quad_count() /
         (kGradingGain + kChainGain * share);
}

/// What meshing again replaces, kept for when no try is valid.
class LastMeshing {
 public:
  explicit LastMeshing(const Quadrangulation& quads)
      : scale_(quads.scale),
        position_(quads.position),
        chains_(quads.chains),
        mesh_(quads.mesh),
        lattice_cells_(quads.lattice_cells) {}

  void restore(Quadrangulation& quads) {
    quads.scale = std::move(scale_);
    quads.position = std::move(position_);
    quads.chains = std::move(chains_);
    quads.mesh = std::move(mesh_);
    quads.lattice_cells = lattice_cells_;
  }

 private:
  ScaleField scale_;
  PositionField position_;
  ChainNetwork chains_;
  QuadMesh mesh_;
  double lattice_cells_;
};

}  // namespace

void refine_by_error(Quadrangulation& quads, const Raster& picture, const Raster& fitted,
                     const VectorizeOptions& options, const RunContext& context) {
  check_options(options);
  check_raster(picture);
  check_raster(fitted);
  const bool whole = quads.outline.empty();
  const Raster& shown = whole ? picture : quads.inside;
  if (fitted.width != shown.width || fitted.height != shown.height) {
    throw Error(ErrorCode::invalid_argument, "the fitted picture differs from the picture in size");
  }
  if (quads.fallback || quads.scale.along_x.data.empty()) return;  // a lattice
  LastMeshing last(quads);
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
  for (int round = 0; round < kMeshRounds; ++round) {
    mesh_to_count(quads, picture, edge, options, wish, clock, context);
    const bool valid = is_valid(quads.mesh, quads.outline, picture);
    if (valid && !leave_out_bad_chains(quads, edge)) break;
    if (!valid && quads.chains.chains.empty()) wish.density = map;
    if (!valid || round + 2 == kMeshRounds) quads.chains = {};
  }
  if (!is_valid(quads.mesh, quads.outline, picture)) last.restore(quads);
  snap_to_features(quads.mesh, shown, options.snap, context);
  clock.finish("snapping");
}

}  // namespace quadrille
