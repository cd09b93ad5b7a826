#pragma once

#include <vector>

#include "quadrille/fit.h"
#include "quadrille/quad_mesh.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"

namespace quadrille {

struct TearOptions {
  enum class Mode {
    off,        ///< no candidate is torn
    automatic,  ///< those that pay for their unknowns
    strong,     ///< every candidate
  };
  Mode mode = Mode::automatic;
  /// A tear must lower the squared error near its chain by at least this share of it, in [0, 1].
  double relative_drop = 0.1;
  /// And for each number that it adds to the description by at least this many times the variance
  /// that remains. In noise an added number lowers the error by one variance; Akaike's criterion
  /// asks for 2, Schwarz's for the logarithm of the number of values, here about 6. At least 0.
  double price = 6;
};

/// Throws Error{invalid_argument} for options outside their ranges, as judge_tears() does.
void check_options(const TearOptions& options);

/// The chains of feature edges inside the mesh: they end where not exactly two feature edges meet,
/// or where these turn by more than 45 degrees. Each lists its edges in order; every feature edge
/// is in one chain.
std::vector<std::vector<int>> feature_edge_chains(const QuadMesh& mesh);

/// Decides which chains of edges to tear; returns a flag per chain.
///
/// A chain is a list of edges of the mesh that follow each other along an image feature; edges on
/// the border of the mesh are ignored. Tears that the mesh has already are given and stay. The
/// picture is fitted (FitMethod::hermite) with all chains torn and with none, on the same geometry,
/// and both fits are compared with it at scale 1. A chain may be torn when its squared error, over
/// the pixels of all quads that touch it, alpha premultiplied, falls by more than the options ask
/// for. Remaining variance: the mean squared error there with the tears, but at least that of half
/// an 8-bit step. Added numbers: value, gradient and twist per channel of every wedge added at the
/// chain's vertices. The error of a jump that is not torn reaches into the quads around it, so
/// chains near a much stronger one are judged again after that one is torn: forward selection in at
/// most four rounds.
///
/// Takes the time of two to five fits. The same for any thread count. Throws
/// Error{invalid_argument} for edges that are not the mesh's or options outside their ranges, and
/// what fit_patches() throws.
std::vector<char> judge_tears(const QuadMesh& mesh, const std::vector<std::vector<int>>& chains,
                              const Raster& picture, const FitOptions& fit = {},
                              const TearOptions& options = {}, const RunContext& context = {});

}  // namespace quadrille
