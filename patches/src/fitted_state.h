#pragma once

#include <vector>

#include "fit_system.h"
#include "quadrille/fit.h"

namespace quadrille {

/// Patches with the colours that fit them to a picture, and what is then known of every pixel.
class FittedState {
 public:
  /// The colours that the patches have are improved upon. Samples that are known from a state of
  /// the same geometry need not be found again. Runs in the caller's tbb arena.
  FittedState(PatchMesh start, const Raster& picture, const FitOptions& fit,
              const RunContext& context, std::vector<SampleBlock> known = {});

  PatchMesh patches;
  std::vector<SampleBlock> samples;
  ColorSystem colors;
  /// Per pixel, y * width + x, halfway between the picture and what the patches show,
  /// premultiplied; the picture where no patch lies.
  std::vector<Color> mean;
  FitReport fit;
  double squared_error = 0, roughness = 0;

  /// The share of pixel y * width + x in the squared error, 0 where no patch lies.
  float squared_error_at(const Raster& picture, std::size_t pixel) const;

  /// Goes on from the colours found so far.
  void improve(const Raster& picture, const FitOptions& options, const RunContext& context);

 private:
  ColorSystem::Vector correction_;  ///< of the colours that the system was made with

  void solve(const FitOptions& options, const RunContext& context);
  void show(const Raster& picture);
  double show_patch(const SampleBlock& block, int local, int channels);
};

}  // namespace quadrille
