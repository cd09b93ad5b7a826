#pragma once

#include <cstdint>
#include <vector>

#include "quadrille/patch_mesh.h"
#include "quadrille/raster.h"
#include "wedge_rows.h"

namespace quadrille {

/// Places where patches show colours that the picture does not have around them: beside tears a few
/// mixed pixels leave much open, and what the fit finds there shows as specks when the picture is
/// enlarged.
class Overshoot {
 public:
  /// Looks at 5 x 5 places of each patch and adds those where a premultiplied channel or alpha lies
  /// more than `allowed` outside the range that it has in the patch's box and one pixel around it.
  /// Returns whether there are new ones. Runs in the caller's tbb arena.
  bool find(const PatchMesh& patches, const Raster& picture, double allowed);

  /// Equations for all places found, each of which weighs like a pixel: the colour that the patches
  /// show now, brought into the range.
  void add_equations(const PatchMesh& patches, WedgeRows& rows) const;

 private:
  struct Place {
    int patch, number;  ///< of the places of a patch
    Eigen::Array4d least, most;
  };
  std::vector<Place> places_;
  std::vector<std::uint32_t> is_found_;  ///< per patch, a bit for each of its places

  void find_in_patch(const PatchMesh& patches, int q, const Raster& picture, double allowed,
                     std::vector<Place>& places);
};

}  // namespace quadrille
