#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "canvas.h"
#include "command.h"
#include "common_options.h"
#include "draw_layer.h"
#include "output_files.h"
#include "picture_input.h"
#include "quadrille/error.h"
#include "quadrille/raster_file.h"
#include "quadrille/stage_layers.h"

namespace quadrille::cli {
namespace {

struct InspectRequest {
  std::filesystem::path input;
  std::filesystem::path output;
  std::string stage;  // empty: all, for .vtm
  double scale = 0;   // 0: chosen by the picture's size
  MeshOptions mesh;
  RunOptions run;
};

/// The raster formats and, where this build has it, .vtm.
std::vector<std::string> inspect_endings() {
  std::vector<std::string> endings = kRasterEndings;
  const std::vector<std::string> all = export_endings();
  if (std::ranges::find(all, ".vtm") != all.end()) endings.push_back(".vtm");
  return endings;
}

int write_all_stages(const InspectRequest& request, const Raster& picture, Observer& observer) {
  const ChosenOptions options = choose_options(request.mesh, picture, observer);
  const auto [result, stages] =
      vectorize_in_stages(picture, request.input, options.vectorize, observer);
  write_outputs({result.image, {&picture, &stages}}, {request.output}, {}, observer);
  return kSuccess;
}

double scale_of(const InspectRequest& request, const Raster& picture) {
  return request.scale > 0 ? request.scale : readable_scale(picture.width, picture.height);
}

void check_drawing(const InspectRequest& request, const Raster& picture) {
  constexpr double kMostPixels = 1e8;  // 2 GB while it is drawn and written
  const double scale = scale_of(request, picture), width = std::round(scale * picture.width),
               height = std::round(scale * picture.height);
  if (width * height <= kMostPixels) return;
  throw Error(ErrorCode::limit_exceeded,
              fmt::format("cannot write '{}': a drawing of {:g} x {:g} pixels is above 100 million "
                          "pixels; choose a smaller --scale",
                          request.output.string(), width, height));
}

int run_inspect(const InspectRequest& request) {
  constexpr double kFade = 0.55;
  const bool all_stages = ending_of(request.output) == ".vtm";
  if (all_stages != request.stage.empty()) {
    throw UsageError(std::string(all_stages ? "a .vtm file holds every stage; leave out --stage"
                                            : "--stage is required unless the output is .vtm") +
                     "; see 'quadrille help inspect'");
  }
  if (all_stages && request.scale > 0) {
    throw UsageError("a .vtm file has no pixels; leave out --scale; see 'quadrille help inspect'");
  }
  check_outputs({request.output}, {request.input, request.mesh.density}, inspect_endings());
  Observer observer(request.run.verbosity(), request.run.threads);
  const Raster picture = read_picture(request.input, observer);
  if (all_stages) return write_all_stages(request, picture, observer);
  check_drawing(request, picture);
  const ChosenOptions options = choose_options(request.mesh, picture, observer);
  const Quadrangulation stages = with_name_of(
      request.input, [&] { return quadrangulate(picture, options.vectorize, observer.context()); });

  const auto chosen = std::ranges::find(scene_stages(), request.stage, &SceneStage::name);
  if (!can_show(*chosen, stages)) {
    throw Error(ErrorCode::degenerate_input,
                fmt::format("'{}' has no {} to draw: its mesh is a plain lattice; {} or draw the "
                            "stage quads",
                            request.input.string(), request.stage,
                            request.mesh.lattice ? "leave out --lattice" : "use a larger picture"));
  }

  const Raster drawing = observer.stage("draw", [&] {
    Canvas canvas(picture, scale_of(request, picture), kFade);
    for (const SceneLayer& layer : chosen->layers(stages, 1 / canvas.zoom())) {
      draw_layer(canvas, layer);
    }
    return canvas.raster();
  });
  observer.stage("write", [&] { save_raster(drawing, request.output); });
  tell_written(request.output, observer);
  return kSuccess;
}

}  // namespace

Action declare_inspect(CLI::App& parser) {
  const auto request = std::make_shared<InspectRequest>();
  std::vector<std::string> names;
  std::string explanation = "what to draw; a .vtm file holds all of them:";
  for (const SceneStage& stage : scene_stages()) {
    names.push_back(stage.name);
    explanation += fmt::format("\n{} - {}", stage.name, stage.summary);
  }
  declare_input(parser, request->input, "picture");
  declare_output(parser, request->output,
                 "drawing of a stage, or .vtm file of all stages and the patches,");
  parser.add_option("--stage", request->stage, explanation)->check(CLI::IsMember(names));
  parser
      .add_option("--scale", request->scale,
                  "drawing pixels per source pixel; about 1600 pixels a side when absent")
      ->check(positive_number());
  declare_quad_options(parser, request->mesh);
  declare_run_options(parser, request->run);
  return [request] { return run_inspect(*request); };
}

}  // namespace quadrille::cli
