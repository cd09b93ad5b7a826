// Each stage's time as a multiple of the time that memset takes for the pixels it reads or writes,
// measured in the same run, so that figures of different machines can be held side by side.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <cstring>
#include <string>
#include <vector>

#include "quadrille/document.h"
#include "quadrille/image_file.h"
#include "quadrille/patch_geometry.h"
#include "quadrille/render.h"
#include "quadrille/vectorize.h"

namespace {

using namespace quadrille;

constexpr int kQuads = 3000;

const Raster& picture() {
  static const Raster loaded =
      load_image(QUADRILLE_SOURCE_DIR "/samples/pictures/flower_tulips.png");
  return loaded;
}

const Quadrangulation& stages() {
  static const Quadrangulation computed = [] {
    VectorizeOptions options;
    options.quads = kQuads;
    return quadrangulate(picture(), options);
  }();
  return computed;
}

/// The 3,000-quad lattice, fitted, so that these figures do not move with the mesh.
const VectorImage& lattice_image() {
  static const VectorImage fitted = [] {
    VectorizeOptions options;
    options.quads = kQuads;
    options.lattice = true;
    return vectorize(picture(), options).image;
  }();
  return fitted;
}

std::size_t bytes_of(const Raster& raster) { return raster.data.size() * sizeof(float); }

void set_bytes(benchmark::State& state, std::size_t bytes) {
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes * state.iterations()));
}

void bench_memset(benchmark::State& state) {
  std::vector<float> target(picture().data.size() * 16);
  for (auto _ : state) {
    std::memset(target.data(), 1, target.size() * sizeof(float));
    benchmark::DoNotOptimize(target.data());
    benchmark::ClobberMemory();
  }
  set_bytes(state, target.size() * sizeof(float));
}

/// A stage that reads the picture.
template <class Stage>
void bench_on_picture(benchmark::State& state, Stage stage) {
  for (auto _ : state) benchmark::DoNotOptimize(stage());
  set_bytes(state, bytes_of(picture()));
}

void bench_render(benchmark::State& state, double scale) {
  RenderOptions options;
  options.scale = scale;
  std::size_t bytes = 0;
  for (auto _ : state) {
    const Raster drawn = render(lattice_image(), options);
    bytes = bytes_of(drawn);
    benchmark::DoNotOptimize(drawn.data.data());
  }
  set_bytes(state, bytes);
}

void bench_fit(benchmark::State& state, FitMethod method) {
  FitOptions options;
  options.method = method;
  PatchMesh patches = lattice_image().layers.front().patches;
  bench_on_picture(state, [&] { return fit_colors(patches, picture(), options).iterations; });
}

void register_stages() {
  const auto add = [](const char* name, auto stage) {
    benchmark::RegisterBenchmark(
        name, [stage](benchmark::State& state) { bench_on_picture(state, stage); });
  };
  add("feature_tensor", [] { return feature_tensor(stages().working.picture).weight.width; });
  add("cross_field", [] { return cross_field(stages().features).z.width; });
  add("relative_scale", [] {
    const Quadrangulation& s = stages();
    const double edge = 2 * std::sqrt(picture().width * picture().height / double{kQuads});
    return relative_scale(s.features, s.cross, edge / s.working.scale_x).along_x.width;
  });
  add("snap_to_features", [] {
    QuadMesh mesh = stages().mesh;
    snap_to_features(mesh, picture());
    return mesh.quad_count();
  });
  add("position_field", [] {
    const Quadrangulation& s = stages();
    return position_field(s.features, s.cross, s.scale).origin.width;
  });
  add("extract_quads", [] {
    const Quadrangulation& s = stages();
    return extract_quads(s.features, s.cross, s.scale, s.position, s.chains, picture().width,
                         picture().height)
        .quad_count();
  });
  add("tangents_and_fold_guard", [] {
    PatchMesh patches = straight_patches(stages().mesh);
    set_bessel_tangents(patches);
    return guard_folds(patches).folded_after;
  });
  benchmark::RegisterBenchmark("fit_colors/bessel", bench_fit, FitMethod::bessel)->UseRealTime();
  benchmark::RegisterBenchmark("fit_colors/hermite", bench_fit, FitMethod::hermite)->UseRealTime();
  benchmark::RegisterBenchmark("render/1x", bench_render, 1.0)->UseRealTime();
  benchmark::RegisterBenchmark("render/4x", bench_render, 4.0)->UseRealTime();
  add("to_document", [] { return to_document(lattice_image()).size(); });
}

/// Prints wall milliseconds and the ratio to the first benchmark's speed.
class RatioReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override {
    fmt::print("{:<26} {:>10} {:>14}\n", "stage", "ms", "x memset");
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.error_occurred) {
        fmt::print("{:<26} {}\n", run.run_name.function_name, run.error_message);
        continue;
      }
      const double seconds = run.real_accumulated_time / static_cast<double>(run.iterations);
      const double speed = run.counters.at("bytes_per_second");
      if (memset_speed_ == 0) memset_speed_ = speed;
      fmt::print("{:<26} {:>10.3f} {:>14.1f}\n", run.run_name.function_name, seconds * 1e3,
                 memset_speed_ / speed);
    }
    std::fflush(stdout);
  }

 private:
  double memset_speed_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  stages();  // so that no stage pays for its inputs
  lattice_image();
  benchmark::RegisterBenchmark("memset", bench_memset)->UseRealTime();
  register_stages();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
