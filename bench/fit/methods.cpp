#include "fit/methods.h"

#include <algorithm>

#include "quadrille/error.h"

namespace quadrille::bench {
namespace {

const FitMode& fit_named(const std::string& name) {
  const auto found = std::ranges::find(fit_modes(), name, &FitMode::name);
  if (found == fit_modes().end()) {
    throw Error(ErrorCode::invalid_argument, "there is no fit '" + name + "'");
  }
  return *found;
}

}  // namespace

const std::vector<FitMode>& fit_modes() {
  static const std::vector<FitMode> modes = {{"hermite", FitMethod::hermite, 4},
                                             {"bessel-ls", FitMethod::bessel_ls, 1},
                                             {"bessel", FitMethod::bessel, 1}};
  return modes;
}

VectorizeOptions FitRun::options() const {
  VectorizeOptions options;
  options.quads = quads;
  options.lattice = lattice;
  options.fit.method = fit.method;
  return options;
}

std::vector<FitRun> fit_runs(const std::vector<std::string>& fits, const std::vector<int>& quads) {
  std::vector<FitMode> modes;
  for (const std::string& name : fits) modes.push_back(fit_named(name));
  if (modes.empty()) modes = fit_modes();
  std::vector<FitRun> runs;
  for (const int count : quads) {
    for (const FitMode& mode : modes) {
      for (const bool lattice : {false, true}) runs.push_back({mode, lattice, count});
    }
  }
  return runs;
}

}  // namespace quadrille::bench
