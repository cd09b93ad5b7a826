#include "view_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>

#include "chosen_options.h"
#include "command.h"
#include "display.h"
#include "interrupt.h"
#include "output_files.h"
#include "picture_input.h"
#include "quadrille/error.h"
#include "quadrille/raster_file.h"
#include "view_options.h"
#include "viewer_window.h"

namespace quadrille::viewer {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// At once, also into a pipe, since the window may stay open for long.
void tell(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

/// What the files give, and how a source would be vectorized.
struct Opened {
  Subject subject;
  VectorizeOptions vectorize;
};

/// Nothing could heed these options.
void check_sourceless(const ViewOptions& options) {
  cli::check_mesh_options(options.input, options.mesh);
  if (!options.compare) return;
  throw cli::UsageError("--compare needs the picture that '" + options.input.string() +
                        "' was made of; give it with --source PICTURE");
}

/// What the patches were made of; null where nobody knows it, and where the file's own cannot be
/// read and nothing asks for it.
std::shared_ptr<const Raster> source_of(const VectorImage& image, const ViewOptions& options,
                                        cli::Observer& observer) {
  try {
    return cli::read_source(options.input, options.source, image, observer);
  } catch (const Error& error) {
    const bool is_needed =
        !options.source.empty() || options.compare || options.mesh != cli::MeshOptions{};
    if (is_needed || error.code() == ErrorCode::cancelled) throw;
    observer.warn("shown without its source: " + cli::one_line(error.what()));
    return nullptr;
  }
}

Opened open(const ViewOptions& options, cli::Observer& observer) {
  Opened opened;
  if (cli::is_document(options.input)) {
    opened.subject.image = std::make_shared<const VectorImage>(
        cli::read_vector_image(options.input, options.mesh, observer));
    opened.subject.source = source_of(*opened.subject.image, options, observer);
  } else {
    if (!options.source.empty()) {
      throw cli::UsageError("--source goes with a file of patches; a picture is its own source");
    }
    opened.subject.source =
        std::make_shared<const Raster>(cli::read_raster(options.input, observer));
  }
  if (!opened.subject.source) {
    check_sourceless(options);
    return opened;
  }
  cli::MeshOptions mesh = options.mesh;
  if (opened.subject.image) {
    if (!mesh.quads) mesh.quads = std::max(opened.subject.image->patch_count(), 1);
  }
  opened.vectorize = choose_options(mesh, *opened.subject.source, observer).vectorize;
  return opened;
}

WindowSettings settings_for(const ViewOptions& options) {
  WindowSettings settings;
  settings.size = options.size;
  settings.offscreen = !options.screenshot.empty();
  settings.threads = options.run.threads;
  settings.title = cli::printable_name(options.input) + " - quadrille-view";
  settings.saved = options.input.stem().string() + "-view";
  return settings;
}

void set_up(Session& session, const LayerList& layers, const ViewOptions& options) {
  session.layers = layers;
  if (options.zoom) session.view.zoom_to(*options.zoom);
  if (options.center) session.view.look_at(*options.center);
  session.comparing = options.compare.has_value();
  session.divider = options.compare.value_or(session.divider);
}

/// Computes all that a screenshot shows, as the window would in the background.
void complete(Opened& opened, const LayerList& layers, const ViewOptions& options,
              cli::Observer& observer) {
  Subject& subject = opened.subject;
  if (!subject.image) {
    subject.image = std::make_shared<const VectorImage>(
        cli::vectorize_picture(*subject.source, options.input, opened.vectorize, observer).image);
  }
  const SubjectLayers available(subject);
  const bool awaited = std::ranges::any_of(layer_infos(), [&](const LayerInfo& info) {
    return layers.shown(info.id) && available.awaits_stages(info.id);
  });
  if (awaited) {
    subject.stages = std::make_shared<const Quadrangulation>(
        quadrangulate(*subject.source, opened.vectorize, observer.context()));
  }
  const SubjectLayers complete(subject);
  for (const LayerInfo& info : layer_infos()) {
    if (!layers.shown(info.id) || complete.missing(info.id).empty()) continue;
    throw Error(ErrorCode::invalid_argument,
                fmt::format("the layer '{}' of '{}' cannot be shown ({}); leave it out or give "
                            "--source PICTURE",
                            info.name, options.input.string(), complete.missing(info.id)));
  }
}

/// Draws so many frames, with a change of the view before each.
void print_rate(const char* name, int frames, ViewerWindow& window,
                const std::function<void(View&, bool forth)>& change) {
  const View before = window.session().view;
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < frames; ++i) {
    change(window.session().view, i < frames / 2);
    window.draw();
  }
  tell(fmt::format("{}: {:.1f} frames a second", name, frames / seconds_since(start)));
  window.session().view = before;
}

void print_rates(ViewerWindow& window) {
  constexpr double kStep = 7;  // window pixels
  print_rate("pan", 120, window, [](View& view, bool forth) {
    view.pan(Eigen::Vector2d::Constant(forth ? kStep : -kStep));
  });
  print_rate("zoom", 32, window,
             [](View& view, bool forth) { view.zoom_to(view.zoom() * (forth ? 1.25 : 0.8)); });
}

int view(const ViewOptions& options) {
  const Clock::time_point start = Clock::now();
  const bool screenshot = !options.screenshot.empty();
  if (screenshot) {
    cli::check_outputs({options.screenshot}, {options.input, options.source, options.mesh.density},
                       {".png"});
  }
  const LayerList layers = options.layers.empty() ? LayerList() : parse_layers(options.layers);
  const DisplayConnection display;  // complain of it before anything is computed
  cli::Observer observer(options.run.verbosity(), options.run.threads, "quadrille-view");
  Opened opened = open(options, observer);
  if (screenshot) complete(opened, layers, options, observer);
  if (options.timings) tell(fmt::format("read: {:.3f} s", seconds_since(start)));

  ViewerWindow window(opened.subject, opened.vectorize, settings_for(options));
  set_up(window.session(), layers, options);
  if (opened.subject.source && (!screenshot || options.panels)) window.add_sliders();
  if (options.pick) window.pick_at(*options.pick);
  window.draw();
  if (options.timings) {
    tell(fmt::format("shown: {:.3f} s", seconds_since(start)));
    print_rates(window);
  }
  if (screenshot) {
    save_raster(window.pixels(options.panels), options.screenshot);
    return cli::kSuccess;
  }
  if (!opened.subject.image) window.vectorize_again();
  window.compute_missing();
  window.run();
  if (cli::interrupting_signal()) throw Error(ErrorCode::cancelled, "stopped");
  return cli::kSuccess;
}

}  // namespace

int run_view(std::vector<std::string> arguments) {
  CLI::App parser("Shows pictures as patches, and all that lies behind them.", "quadrille-view");
  parser.set_version_flag("--version", "quadrille-view " QUADRILLE_VERSION);
  parser.footer("Keys in the window: h lists them.");
  ViewOptions options;
  declare_view_options(parser, options);
  try {
    std::ranges::reverse(arguments);  // the order in which the parser takes them
    parser.parse(arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      parser.exit(error);  // prints the help or the version
      return cli::kSuccess;
    }
    throw cli::UsageError(cli::one_line(error.what()) + "; see 'quadrille-view --help'");
  }
  return view(options);
}

}  // namespace quadrille::viewer
