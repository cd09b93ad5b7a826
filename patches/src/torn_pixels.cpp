#include "torn_pixels.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "outline_pixels.h"
#include "patch_shader.h"

namespace quadrille {
namespace {

constexpr float kWhole = 1 - 0.5f / (OutlinePixels::kDivision * OutlinePixels::kDivision);

bool has_tears(const QuadMesh& mesh) {
  return std::any_of(mesh.edge_flags.begin(), mesh.edge_flags.end(),
                     [](std::uint8_t flags) { return flags & kTearEdge; });
}

std::vector<TornPixel> torn_in_window(const LayerScene& scene, const SampleWindow& window,
                                      int width) {
  const auto patches = scene.patches_at(window);
  OutlinePixels outline;
  outline.find(scene, patches, window);
  const std::size_t count = outline.pixels().size();
  std::vector<Color> colors(count, Color::Zero());
  std::vector<float> covered(count, 0.0f);
  std::vector<OutlinePixels::Share> shares;
  PatchShader::Batch batch;
  for (const int q : patches) {
    outline.take(scene, q, shares);
    if (shares.empty()) continue;
    PatchShader shader(scene.patches(), q, scene.to_samples(), scene.from_samples());
    for (std::size_t first = 0; first < shares.size(); first += PatchShader::kBatch) {
      const std::size_t left = shares.size() - first;
      batch.count = static_cast<int>(std::min<std::size_t>(PatchShader::kBatch, left));
      for (int i = 0; i < batch.count; ++i) {
        const OutlinePixels::Share& share = shares[first + i];
        const OutlinePixels::Pixel& p = outline.pixels()[share.pixel];
        batch.x[i] = static_cast<float>(p.x - shader.origin()[0]) + share.x;
        batch.y[i] = static_cast<float>(p.y - shader.origin()[1]) + share.y;
      }
      shader.shade(batch);
      for (int i = 0; i < batch.count; ++i) {
        const OutlinePixels::Share& share = shares[first + i];
        for (int c = 0; c < 4; ++c) colors[share.pixel][c] += batch.color[c][i] * share.weight;
        covered[share.pixel] += share.weight;
      }
    }
  }
  std::vector<TornPixel> torn;
  for (std::size_t i = 0; i < count; ++i) {
    if (covered[i] < kWhole) continue;
    const OutlinePixels::Pixel& p = outline.pixels()[i];
    torn.push_back({static_cast<std::uint32_t>(p.y) * static_cast<std::uint32_t>(width) +
                        static_cast<std::uint32_t>(p.x),
                    colors[i]});
  }
  return torn;
}

}  // namespace

std::vector<TornPixel> torn_pixels(const PatchMesh& patches, int width, int height) {
  std::vector<TornPixel> all;
  if (!has_tears(patches.mesh)) return all;
  Layer layer;
  layer.patches = patches;
  const LayerScene scene(layer, {1, 1}, {0, 0, width, height});
  const int columns = (width + kBlockSide - 1) / kBlockSide;
  const int rows = (height + kBlockSide - 1) / kBlockSide;
  std::vector<std::vector<TornPixel>> found(std::size_t{1} * columns * rows);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t b) {
    const int x = static_cast<int>(b % columns) * kBlockSide;
    const int y = static_cast<int>(b / columns) * kBlockSide;
    const SampleWindow window = {x, y, std::min(x + kBlockSide, width),
                                 std::min(y + kBlockSide, height)};
    found[b] = torn_in_window(scene, window, width);
  });
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace quadrille
