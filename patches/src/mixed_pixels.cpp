#include "mixed_pixels.h"

#include <algorithm>
#include <numeric>

#include "outline_pixels.h"
#include "parallel_ranges.h"
#include "patch_bins.h"
#include "picture_sampling.h"

namespace quadrille {
namespace {

/// True for edges that the renderer may find crossing pixels: tears, and the border of the mesh
/// except along the picture's sides.
bool may_cross_pixels(const QuadMesh& mesh, int e, const Raster& picture) {
  if (!mesh.is_border(e)) return mesh.is_tear(e);
  const int h = mesh.halfedge(e);
  const Eigen::Array2d p = mesh.vertices[mesh.origin(h)], q = mesh.vertices[mesh.tip(h)];
  const Eigen::Array2d size(picture.width, picture.height);
  return !((p == 0 && q == 0) || (p == size && q == size)).any();
}

bool has_mixed_pixels(const QuadMesh& mesh, const Raster& picture) {
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (may_cross_pixels(mesh, e, picture)) return true;
  }
  return false;
}

/// The rows of the pixels of one block.
struct BlockRows {
  using Entry = WedgeRows::Entry;
  struct Row {
    int x, y;
    float covered = 0;
    Eigen::Vector2d center = {0, 0};  ///< of the covered part, times its area
    std::vector<Entry> entries = {};

    /// The picture's colour of the covered part, times its area.
    Eigen::Array4d color(const Raster& picture) const {
      if (covered >= 1) return premultiplied_pixel(picture, x, y).cast<double>();
      return sample_bilinear(picture, center / covered) * covered;
    }
  };
  std::vector<Row> rows;
  std::vector<std::pair<int, double>> open_areas;  ///< patch, area

  void find(const PatchScan& scan, std::span<const int> seen, const SampleWindow& window) {
    const PatchMesh& patches = scan.patches();
    OutlinePixels outline;
    outline.find(scan, seen, window);
    for (const OutlinePixels::Pixel& p : outline.pixels()) rows.push_back({p.x, p.y});
    if (rows.empty()) return;
    std::vector<OutlinePixels::Share> shares;
    for (const int q : seen) {
      outline.take(scan, q, shares);
      if (shares.empty()) continue;
      const std::array<CornerMap, 4> corners = corner_maps(patches, q);
      const PatchInverse inverse(patch_geometry(patches, q));
      open_areas.emplace_back(q, 0);
      for (const OutlinePixels::Share& share : shares) {
        open_areas.back().second += share.weight * (1 - share.weight);
        Row& row = rows[share.pixel];
        const Eigen::Vector2d point(row.x + share.x, row.y + share.y);
        const auto factors = corner_factors(corners, inverse(point));
        row.covered += share.weight;
        row.center += point * share.weight;
        for (int k = 0; k < 4; ++k) {
          add(row, patches.wedge_of_corner[4 * q + k], factors[k] * share.weight);
        }
      }
    }
    std::erase_if(rows, [](const Row& row) { return row.entries.empty(); });
    for (Row& row : rows) {
      std::sort(row.entries.begin(), row.entries.end(),
                [](const Entry& a, const Entry& b) { return a.wedge < b.wedge; });
    }
  }

 private:
  static void add(Row& row, int wedge, const Eigen::Vector4f& factors) {
    for (Entry& e : row.entries) {
      if (e.wedge != wedge) continue;
      e.factors += factors;
      return;
    }
    row.entries.push_back({wedge, factors});
  }
};

}  // namespace

MixedPixels::MixedPixels(const PatchScan& scan, const Raster& picture, WedgeRows& rows) {
  const PatchMesh& patches = scan.patches();
  if (!has_mixed_pixels(patches.mesh, picture)) return;
  const SampleWindow whole = {0, 0, picture.width, picture.height};
  std::vector<int> all(patches.patch_count());
  std::iota(all.begin(), all.end(), 0);
  PatchBins bins;
  bins.fill(scan, all, whole);
  const int columns = (picture.width + kBlockSide - 1) / kBlockSide;
  const int lines = (picture.height + kBlockSide - 1) / kBlockSide;
  std::vector<BlockRows> blocks(static_cast<std::size_t>(columns) * lines);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    const int x = static_cast<int>(b % columns) * kBlockSide;
    const int y = static_cast<int>(b / columns) * kBlockSide;
    const SampleWindow block = intersection({x, y, x + kBlockSide, y + kBlockSide}, whole);
    blocks[b].find(scan, bins.at(block), block);
  });

  is_mixed_.assign(static_cast<std::size_t>(picture.width) * picture.height, 0);
  open_area_.assign(patches.patch_count(), 0);
  for (const BlockRows& block : blocks) {
    for (const auto& [patch, area] : block.open_areas) open_area_[patch] += area;
    for (const BlockRows::Row& row : block.rows) {
      pixels_.push_back(static_cast<std::size_t>(row.y) * picture.width + row.x);
      is_mixed_[pixels_.back()] = 1;
      rows.add(row.entries, patches, row.color(picture));
    }
  }
}

}  // namespace quadrille
