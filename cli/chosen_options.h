#pragma once

#include <optional>
#include <string>

#include "common_options.h"
#include "observer.h"
#include "quadrille/preset.h"

namespace quadrille::cli {

/// What the command line means for one picture: the preset's options, then those given.
struct ChosenOptions {
  VectorizeOptions vectorize;
  std::string preset;
  std::optional<Content> content;  ///< why this preset; absent when the command line names it
};

/// Reads the density map; tells the watcher which preset it is and why.
ChosenOptions choose_options(const MeshOptions& mesh, const Raster& picture, Observer& observer);

}  // namespace quadrille::cli
