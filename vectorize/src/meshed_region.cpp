#include "meshed_region.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "inside_test.h"
#include "quadrille/error.h"
#include "quadrille/mesh_region.h"

namespace quadrille {
namespace {

// Loops of an outline with fewer square pixels are specks and pinholes.
constexpr double kLeastLoopArea = 4;
// A small loop takes some 12 quads, and half of the quads are to stay for the inside.
constexpr int kLeastQuadsPerLoop = 24;

}  // namespace

std::vector<Loop> wanted_outline(const Raster& picture, const VectorizeOptions& options) {
  if (options.region == MeshRegion::whole || !picture.has_alpha()) return {};
  std::vector<Loop> outline = alpha_outline(picture, kLeastLoopArea);
  if (outline.empty()) {
    throw Error(
        ErrorCode::degenerate_input,
        "the picture has no opaque pixel and so no outline; mesh the whole picture instead");
  }
  const std::size_t most = std::max(1, options.quads / kLeastQuadsPerLoop);
  if (outline.size() > most) {
    // A loop inside of another one is smaller, so what goes leaves nothing behind in it.
    std::ranges::stable_sort(outline, std::greater<>(),
                             [](const Loop& loop) { return std::abs(signed_area(loop)); });
    outline.resize(most);
  }
  if (is_frame(outline, picture.width, picture.height, kLeastLoopArea)) return {};
  return outline;
}

double region_area(const std::vector<Loop>& outline, const Raster& picture) {
  if (outline.empty()) return static_cast<double>(picture.width) * picture.height;
  double area = 0;
  for (const Loop& loop : outline) area += signed_area(loop);
  return area;
}

double share_of_cells(const std::vector<Loop>& outline, const WorkingPicture& working,
                      const ScaleField& scale) {
  const InsideTest inside(outline);
  double all = 0, in_region = 0;
  for (int y = 0; y < scale.along_x.height; ++y) {
    for (int x = 0; x < scale.along_x.width; ++x) {
      const double cells = 1 / (static_cast<double>(scale.along_x(x, y)) * scale.along_y(x, y));
      all += cells;
      if (inside({(x + 0.5) * working.scale_x, (y + 0.5) * working.scale_y})) {
        in_region += cells;
      }
    }
  }
  // Of a tiny region no pixel may be inside.
  return std::max(in_region, 1.0) / all;
}

}  // namespace quadrille
