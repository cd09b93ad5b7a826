#include "pdf_tear_lines.h"

#include <algorithm>

#include "patch_sides.h"

namespace quadrille {
namespace {

/// In the mean along half-edge h.
float alpha_along(const PatchMesh& patches, int h) {
  const auto color = ferguson_patch(patches, QuadMesh::quad_of(h)).color;
  float sum = 0;
  for (const double t : {0.125, 0.375, 0.625, 0.875}) {
    const Eigen::Vector2d uv = on_side(QuadMesh::corner_of(h), t);
    sum += std::clamp(color.at(uv.x(), uv.y())[3], 0.0f, 1.0f);
  }
  return sum / 4;
}

}  // namespace

TearLines tear_lines(const PatchMesh& patches, const PaintGroups& groups, int group) {
  TearLines lines;
  if (patches.opaque) return lines;
  const QuadMesh& mesh = patches.mesh;
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    if (groups.group[QuadMesh::quad_of(h)] != group) continue;
    const int twin = mesh.twin(h);
    const bool painted = twin >= 0 && groups.paints(QuadMesh::quad_of(twin));
    if (!painted || across(mesh, groups, h) != Across::outside) continue;
    const float here = alpha_along(patches, h), there = alpha_along(patches, twin);
    if (here > 3 * there) lines.growing.push_back(h);
    if (there > 3 * here) lines.shrinking.push_back(h);
  }
  return lines;
}

}  // namespace quadrille
