// The rasterizer's speed per thread as a multiple of Cairo's mesh patterns, in one run: Cairo with
// one bilinear patch for each of ours, with 4 x 4 of them, and memset of as many bytes.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "quadrille/document.h"
#include "quadrille/image_file.h"
#include "quadrille/patch_geometry.h"
#include "quadrille/renderer.h"
#include "quadrille/vectorize.h"
#include "render/cairo_mesh.h"

namespace {

using namespace quadrille;
using bench::CairoMesh;

struct Scene {
  std::string name;
  VectorImage image;
};

/// The sample's field-aligned mesh with curved edges and fitted colours.
Scene sample_scene(int quads) {
  const Raster picture = load_image(QUADRILLE_SOURCE_DIR "/samples/pictures/flower_tulips.png");
  VectorizeOptions options;
  options.quads = quads;
  Layer layer;
  layer.patches = straight_patches(quadrangulate(picture, options).mesh);
  set_bessel_tangents(layer.patches);
  guard_folds(layer.patches);
  fit_colors(layer.patches, picture);
  Scene scene{fmt::format("{} patches", layer.patches.patch_count()), {}};
  scene.image.width = picture.width;
  scene.image.height = picture.height;
  scene.image.layers.push_back(std::move(layer));
  return scene;
}

struct View {
  const char* name;
  double scale;
  int crop;  ///< side of the region in the middle, 0 for all of it
};

constexpr View kViews[] = {
    {"0.25x", 0.25, 0}, {"1x", 1, 0}, {"4x", 4, 0}, {"16x", 16, 0}, {"64x crop", 64, 2048}};

RenderOptions options_of(const VectorImage& image, const View& view) {
  RenderOptions options;
  options.scale = view.scale;
  const auto [width, height] = output_size(image, options);
  options.region = PixelRegion{0, 0, width, height};
  if (view.crop) {
    options.region =
        PixelRegion{(width - view.crop) / 2, (height - view.crop) / 2, view.crop, view.crop};
  }
  return options;
}

/// Registers `run`, which paints all pixels of the region once.
template <class Run>
void add(const Scene& scene, const View& view, const char* method, const PixelRegion& region,
         const Run& run) {
  benchmark::RegisterBenchmark(
      fmt::format("{}|{}|{}", scene.name, view.name, method).c_str(),
      [=](benchmark::State& state) {
        run(state);
        state.SetItemsProcessed(state.iterations() * region.width * region.height);
      })
      ->MinTime(0.3);
}

/// Draws with one thread into the same 8-bit pixels, each time after `prepare`.
template <class Prepare>
void bench_draw(benchmark::State& state, Renderer& renderer, const RenderOptions& options,
                const Prepare& prepare) {
  RunContext one;
  one.threads = 1;
  const PixelRegion region = *options.region;
  std::vector<std::uint32_t> pixels(std::size_t{1} * region.width * region.height);
  renderer.draw(options, {}, {pixels.data(), region.width * 4}, one);
  for (auto _ : state) {
    prepare(renderer);
    renderer.draw(options, {}, {pixels.data(), region.width * 4}, one);
    benchmark::ClobberMemory();
  }
}

/// Frames by one and by two threads in turn; the best wall times' ratio, since only undisturbed
/// runs of two threads say anything.
void bench_two_threads(benchmark::State& state, const VectorImage& image,
                       const RenderOptions& options) {
  using Clock = std::chrono::steady_clock;
  const PixelRegion region = *options.region;
  std::vector<std::uint32_t> pixels(std::size_t{1} * region.width * region.height);
  Renderer renderers[2] = {Renderer(image), Renderer(image)};
  double best[2] = {INFINITY, INFINITY};
  const auto draw = [&](int i) {
    RunContext context;
    context.threads = i + 1;
    const auto begin = Clock::now();
    renderers[i].draw(options, {}, {pixels.data(), region.width * 4}, context);
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  for (int i = 0; i < 2; ++i) draw(i);
  for (auto _ : state) {
    for (int i = 0; i < 2; ++i) best[i] = std::min(best[i], draw(i));
  }
  state.counters["two threads over one"] = best[0] / best[1];
}

void add_view(const Scene& scene, const View& view) {
  const VectorImage& image = scene.image;
  const RenderOptions options = options_of(image, view);
  const PixelRegion region = *options.region;
  for (const int divisions : {1, 4}) {
    add(scene, view, divisions == 1 ? "cairo" : "cairo 4x4", region,
        [=, &image](benchmark::State& state) {
          CairoMesh mesh(image, view.scale, region, divisions);
          for (auto _ : state) mesh.paint();
        });
  }
  add(scene, view, "memset", region, [=](benchmark::State& state) {
    std::vector<std::uint32_t> pixels(std::size_t{1} * region.width * region.height);
    for (auto _ : state) {
      std::memset(pixels.data(), 1, pixels.size() * sizeof(pixels[0]));
      benchmark::ClobberMemory();
    }
  });
  add(scene, view, "render()", region, [=, &image](benchmark::State& state) {
    RunContext one;
    one.threads = 1;
    for (auto _ : state) benchmark::DoNotOptimize(render(image, options, one).data.data());
  });
  // What a viewer does: 8-bit pixels again and again, patches and outlines set up before.
  add(scene, view, "frame", region, [=, &image](benchmark::State& state) {
    Renderer renderer(image);
    bench_draw(state, renderer, options, [](Renderer&) {});
  });
  // All from the picture's control points to 8-bit pixels.
  add(scene, view, "once", region, [=, &image](benchmark::State& state) {
    Renderer renderer(image);
    bench_draw(state, renderer, options, [&](Renderer& r) { r = Renderer(image); });
  });
  add(scene, view, "two threads", region,
      [=, &image](benchmark::State& state) { bench_two_threads(state, image, options); });
}

/// One line per view and method: CPU time, speed, and its ratio to the others' of the same view.
class RatioReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override {
    fmt::print("{:<15} {:<9} {:<12} {:>10} {:>9} {:>8} {:>11} {:>9}\n", "scene", "view", "method",
               "CPU ms", "Mpx/s", "x cairo", "x cairo 4x4", "x memset");
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const std::string& name = run.run_name.function_name;
      const auto first = name.find('|'), second = name.rfind('|');
      const std::string view = name.substr(0, second), method = name.substr(second + 1);
      if (run.error_occurred) {
        fmt::print("{} {}\n", name, run.error_message);
        continue;
      }
      if (const auto found = run.counters.find("two threads over one");
          found != run.counters.end()) {
        fmt::print("{:<15} {:<9} {:<12} {:.2f} times as fast as one, best wall times\n",
                   name.substr(0, first), name.substr(first + 1, second - first - 1), method,
                   found->second.value);
        continue;
      }
      const double seconds = run.cpu_accumulated_time / static_cast<double>(run.iterations);
      const double speed = run.counters.at("items_per_second");
      speeds_[view][method] = speed;
      const auto ratio = [&](const char* other) {
        const auto found = speeds_[view].find(other);
        return found == speeds_[view].end() ? 0.0 : speed / found->second;
      };
      fmt::print("{:<15} {:<9} {:<12} {:>10.3f} {:>9.1f} {:>8.2f} {:>11.2f} {:>9.3f}\n",
                 name.substr(0, first), name.substr(first + 1, second - first - 1), method,
                 seconds * 1e3, speed / 1e6, ratio("cairo"), ratio("cairo 4x4"), ratio("memset"));
    }
    std::fflush(stdout);
  }

 private:
  std::map<std::string, std::map<std::string, double>> speeds_;
};

}  // namespace

/// Documents may be named in place of the sample.
int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::vector<Scene> scenes;
  for (int i = 1; i < argc; ++i) scenes.push_back({argv[i], load_document(argv[i])});
  if (scenes.empty()) {
    for (const int quads : {3000, 30000}) scenes.push_back(sample_scene(quads));
  }
  for (const Scene& scene : scenes) {
    for (const View& view : kViews) add_view(scene, view);
  }
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
