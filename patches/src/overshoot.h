#pragma once

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
  /// Adds the places where a channel lies more than `allowed` outside the range that it has in the
  /// pixels around the patch. Returns whether there are any. Runs in the caller's tbb arena.
  bool find(const PatchMesh& patches, const Raster& picture, double allowed);

  /// Equations for all places found, each of which weighs like a pixel: the colour that the patches
  /// show now, brought into the range.
  void add_equations(const PatchMesh& patches, WedgeRows& rows) const;

 private:
  struct Place {
    int patch;
    Eigen::Vector2d uv;
    Eigen::Array4d least, most;
  };
  std::vector<Place> places_;

  static void find_in_patch(const PatchMesh& patches, int q, const Raster& picture, double allowed,
                            std::vector<Place>& places);
};

}  // namespace quadrille
