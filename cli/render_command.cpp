#include <fmt/core.h>

#include <charconv>
#include <memory>
#include <optional>

#include "command.h"
#include "common_options.h"
#include "output_files.h"
#include "picture_input.h"
#include "quadrille/error.h"
#include "quadrille/raster_file.h"
#include "quadrille/render.h"

namespace quadrille::cli {
namespace {

struct RenderRequest {
  std::filesystem::path input;
  std::filesystem::path output;
  double scale = 1;
  int width = 0;
  std::string region;
  int bits = 8;
  MeshOptions mesh;
  RunOptions run;
};

/// Four whole numbers between commas: the left and top, the width and height.
std::optional<PixelRegion> parse_region(const std::string& text) {
  PixelRegion region;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int* number : {&region.x, &region.y, &region.width, &region.height}) {
    const auto [next, error] = std::from_chars(at, end, *number);
    if (error != std::errc()) return std::nullopt;
    const bool last = number == &region.height;
    if (last ? next != end : (next == end || *next != ',')) return std::nullopt;
    at = next + 1;
  }
  if (region.x < 0 || region.y < 0 || region.width < 1 || region.height < 1) return std::nullopt;
  return region;
}

CLI::Validator region_syntax() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        if (parse_region(text)) return "";
        return fmt::format("'{}' is not X,Y,W,H in output pixels with W and H above 0", text);
      },
      "X,Y,W,H", "region");
}

void check_region(const RenderRequest& request, const PixelRegion& region,
                  const std::array<int, 2>& size) {
  if (region.x <= size[0] - region.width && region.y <= size[1] - region.height) return;
  throw Error(ErrorCode::invalid_argument,
              fmt::format("cannot write '{}': the region {},{},{},{} is not inside the output of "
                          "{} x {} pixels; choose one that is",
                          request.output.string(), region.x, region.y, region.width, region.height,
                          size[0], size[1]));
}

int run_render(const RenderRequest& request) {
  check_mesh_options(request.input, request.mesh);
  check_outputs({request.output}, {request.input, request.mesh.density}, kRasterEndings);
  Observer observer(request.run.verbosity(), request.run.threads);
  const VectorImage image = read_vector_image(request.input, request.mesh, observer);

  RasterFileOptions file;
  file.scale = request.scale;
  file.width = request.width;
  file.bits = request.bits;
  check_size(image.width, image.height, file, request.output);
  observer.stage("render", [&] {
    if (request.region.empty()) {
      write_raster_file(image, request.output, file, observer.context());
      return;
    }
    RenderOptions options;
    options.scale = request.scale;
    options.width = request.width;
    options.region = parse_region(request.region);
    check_region(request, *options.region, output_size(image, options));
    save_raster(render(image, options, observer.context()), request.output, file);
  });
  tell_written(request.output, observer);
  return kSuccess;
}

}  // namespace

Action declare_render(CLI::App& parser) {
  const auto request = std::make_shared<RenderRequest>();
  declare_input(parser, request->input,
                "file of patches (.quad, .vtu or .vtm), or a picture to vectorize first");
  declare_output(parser, request->output);
  CLI::Option* scale =
      parser.add_option("--scale", request->scale, "output pixels per source pixel")
          ->check(positive_number())
          ->capture_default_str();
  parser.add_option("--width", request->width, "width of the whole output in pixels")
      ->check(whole_number_from(1, 1 << 30))
      ->excludes(scale);
  parser
      .add_option("--region", request->region,
                  "draw only this part of the output, in output pixels")
      ->check(region_syntax());
  parser.add_option("--bits", request->bits, "bits per channel; 16 for PNG and TIFF")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str();
  declare_mesh_options(parser, request->mesh);
  declare_run_options(parser, request->run);
  return [request] { return run_render(*request); };
}

}  // namespace quadrille::cli
