#include "view_options.h"

#include <fmt/core.h>

#include <charconv>

#include "layer_list.h"
#include "quadrille/error.h"

namespace quadrille::viewer {
namespace {

/// Two numbers with a separator between them.
template <class Number>
std::optional<Eigen::Array<Number, 2, 1>> parse_pair(const std::string& text, char separator) {
  Eigen::Array<Number, 2, 1> pair;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, pair[0]);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != separator) return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, pair[1]);
  if (second.ec != std::errc() || second.ptr != end) return std::nullopt;
  return pair;
}

bool set_size(const std::string& text, ViewOptions& options) {
  constexpr int kLeast = 16, kMost = 8192;
  const auto size = parse_pair<int>(text, 'x');
  if (!size || size->minCoeff() < kLeast || size->maxCoeff() > kMost) return false;
  options.size = *size;
  return true;
}

bool set_point(const std::string& text, std::optional<Eigen::Vector2d>& point) {
  const auto pair = parse_pair<double>(text, ',');
  if (!pair || !pair->allFinite()) return false;
  point = pair->matrix();
  return true;
}

bool set_center(const std::string& text, ViewOptions& options) {
  return set_point(text, options.center);
}

bool set_pick(const std::string& text, ViewOptions& options) {
  return set_point(text, options.pick);
}

std::string complaint_about_layers(const std::string& text) {
  try {
    parse_layers(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void add_parsed(CLI::App& parser, ViewOptions& options, const std::string& name,
                const std::string& syntax, bool (*set)(const std::string&, ViewOptions&),
                const std::string& help) {
  parser
      .add_option_function<std::string>(
          name,
          [&options, set, name, syntax, help](const std::string& text) {
            if (!set(text, options)) {
              throw CLI::ValidationError(name,
                                         fmt::format("'{}' is not {}: {}", text, syntax, help));
            }
          },
          help)
      ->type_name(syntax);
}

}  // namespace

void declare_view_options(CLI::App& parser, ViewOptions& options) {
  cli::declare_input(parser, options.input, "picture, or file of patches (.quad, .vtu, .vtm)");
  parser
      .add_option(
          "--source", options.source,
          "the picture that the patches were made of, for their error, fields and comparison")
      ->check(cli::file_name())
      ->type_name("PICTURE");
  CLI::Option* screenshot = parser
                                .add_option("--screenshot", options.screenshot,
                                            "draw the view into a file instead of a window")
                                ->check(cli::file_name())
                                ->type_name("OUT.png");
  parser
      .add_option("--layers", options.layers,
                  "layers to show, with opacities where wished: picture,patches:0.5")
      ->check(CLI::Validator(complaint_about_layers, "", "layers"))
      ->type_name("NAME[:OPACITY],...");
  parser
      .add_option("--zoom", options.zoom,
                  "window pixels per source pixel; the picture fits into the window when absent")
      ->check(cli::positive_number());
  add_parsed(parser, options, "--center", "X,Y", set_center,
             "source pixel in the middle of the window");
  add_parsed(parser, options, "--pick", "X,Y", set_pick,
             "source pixel to click: picks the patch or vertex there");
  add_parsed(parser, options, "--size", "WxH", set_size,
             "size of the window, 16 to 8192 pixels a side; 1200x800 when absent");
  parser
      .add_option("--compare", options.compare,
                  "show the source left of this share of the window, 0 to 1")
      ->check(cli::number_from(0, 1));
  parser.add_flag("--panels", options.panels, "texts and sliders in the screenshot, too")
      ->needs(screenshot);
  parser.add_flag(
      "--timings", options.timings,
      "print how long opening takes and how many frames a second panning and zooming show");
  cli::declare_mesh_options(parser, options.mesh);
  cli::declare_run_options(parser, options.run);
}

}  // namespace quadrille::viewer
