#include "fit/upscale.h"

#include "fit/edge_error.h"
#include "own_process.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "quadrille/preset.h"
#include "quadrille/render.h"
#include "quadrille/vectorize.h"
#include "resample.h"

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFactor = 4;

Json quality(const Raster& original, const Raster& result) {
  const ImageDifference difference = compare(original, result);
  return {{"psnr", difference.psnr},
          {"ssim", difference.ssim},
          {"mae", difference.mae},
          {"edge_mae", edge_error(original, result)}};
}

double ratio(const Json& figures, const char* method, const char* reference, const char* figure) {
  return figures[method][figure].get<double>() / figures[reference][figure].get<double>();
}

Json measure(const std::filesystem::path& path, const UpscaleOptions& wish) {
  RunContext context;
  context.threads = wish.threads;
  const Raster whole = load_image(path);
  const Raster original =
      crop(whole, 0, 0, whole.width / kFactor * kFactor, whole.height / kFactor * kFactor);
  const Raster small = reduced(original, kFactor);
  VectorizeOptions options;
  const Preset& preset = choose_preset(original);
  apply(preset, small, options);
  if (preset.name == "photo") {
    options.quads = wish.photo_quads;
  } else if (wish.quads > 0) {
    options.quads = wish.quads;
  }
  const VectorImage image = vectorize(small, options, context).image;
  RenderOptions large;
  large.scale = kFactor;

  Json figures = {{"width", original.width}, {"height", original.height}};
  figures["quads"] = image.patch_count();
  figures["ours"] = quality(original, render(image, large, context));
  for (const auto& [name, interpolation] : {std::pair{"nearest", Interpolation::nearest},
                                            {"bicubic", Interpolation::bicubic},
                                            {"lanczos", Interpolation::lanczos}}) {
    figures[name] = quality(original, enlarged(small, kFactor, interpolation));
  }
  figures["gain"] =
      figures["ours"]["psnr"].get<double>() - figures["lanczos"]["psnr"].get<double>();
  figures["edge_ratio"] = ratio(figures, "ours", "lanczos", "edge_mae");
  return figures;
}

}  // namespace

Json upscale_figures(const std::filesystem::path& picture, const UpscaleOptions& options) {
  return run_in_own_process([&] { return measure(picture, options); });
}

}  // namespace quadrille::bench
