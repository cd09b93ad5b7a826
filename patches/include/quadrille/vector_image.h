#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// One stack level of a VectorImage. The transform takes the mesh's coordinates to the picture's.
struct Layer {
  std::string name = "picture";
  Eigen::Affine2d transform = Eigen::Affine2d::Identity();
  PatchMesh patches;
};

/// A resolution-independent picture over the rectangle [0, width] x [0, height]: layers are drawn
/// in order, later ones over earlier ones; where no patch lies it is transparent.
struct VectorImage {
  double width = 0;   ///< pixels of the source picture
  double height = 0;  ///< pixels of the source picture
  std::vector<Layer> layers;
  std::map<std::string, std::string> metadata;  ///< UTF-8 keys and values, such as the options used

  int patch_count() const;
  /// True when every layer is opaque and the first one fills the rectangle untransformed.
  bool opaque() const;
};

/// The patches alone, untransformed.
VectorImage single_layer(PatchMesh patches, double width, double height);

}  // namespace quadrille
