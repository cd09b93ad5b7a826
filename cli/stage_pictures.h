#pragma once

#include <vector>

#include "canvas.h"
#include "quadrille/vectorize.h"

namespace quadrille::cli {

/// A stage of quadrangulate() that can be drawn.
struct StagePicture {
  const char* name;
  const char* summary;
  bool needs_fields;  ///< cannot be drawn when a lattice was used without any fields
  void (*draw)(Canvas& canvas, const Quadrangulation& stages);
};

/// All of them, in the order of the computation.
const std::vector<StagePicture>& stage_pictures();

}  // namespace quadrille::cli
