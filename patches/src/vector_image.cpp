#include "quadrille/vector_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quadrille {

int VectorImage::patch_count() const {
  int count = 0;
  for (const Layer& layer : layers) count += layer.patches.patch_count();
  return count;
}

bool VectorImage::opaque() const {
  if (layers.empty()) return false;
  for (const Layer& layer : layers) {
    if (!layer.patches.opaque) return false;
  }
  const Layer& bottom = layers.front();
  if (!bottom.transform.isApprox(Eigen::Affine2d::Identity(), 1e-12)) return false;
  double area = 0;
  const QuadMesh& mesh = bottom.patches.mesh;
  for (int q = 0; q < mesh.quad_count(); ++q) area += quad_area(mesh, q);
  return std::abs(area - width * height) <= 1e-9 * width * height;
}

VectorImage single_layer(PatchMesh patches, double width, double height) {
  VectorImage image;
  image.width = width;
  image.height = height;
  image.layers.emplace_back().patches = std::move(patches);
  return image;
}

}  // namespace quadrille
