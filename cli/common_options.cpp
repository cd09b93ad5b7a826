#include "common_options.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "quadrille/preset.h"

namespace quadrille::cli {
namespace {

/// The presets' names and what they are for.
std::string preset_help() {
  std::string text =
      "level of detail, which decides the number of quads by the picture's size unless --quads "
      "does:\nauto - chosen by the picture's content";
  for (const Preset& preset : presets()) {
    text += fmt::format("\n{} - {}, a quad per {} pixels", preset.name, preset.purpose,
                        preset.pixels_per_quad);
  }
  return text;
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names = {"auto"};
  for (const Preset& preset : presets()) names.push_back(preset.name);
  return names;
}

/// Nothing for what is not such a number as a whole.
template <class Number>
std::optional<Number> number_of(const std::string& text) {
  const char* const last = text.data() + text.size();
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

template <class Number>
CLI::Validator within(Number low, Number high, const char* type, const char* name) {
  return CLI::Validator(
      [low, high, name](const std::string& text) -> std::string {
        const std::optional<Number> value = number_of<Number>(text);
        return value && *value >= low && *value <= high
                   ? ""
                   : fmt::format("'{}' is not a {} from {} to {}", text, name, low, high);
      },
      fmt::format("{} in [{} - {}]", type, low, high), std::string(name) + " in range");
}

}  // namespace

Verbosity RunOptions::verbosity() const {
  if (quiet) return Verbosity::quiet;
  return verbose ? Verbosity::verbose : Verbosity::normal;
}

void declare_run_options(CLI::App& parser, RunOptions& options) {
  parser
      .add_option("--threads", options.threads,
                  "worker threads, 0 for all of the machine's; the result never depends on it")
      ->check(whole_number_from(0, 1024))
      ->capture_default_str();
  CLI::Option* verbose =
      parser.add_flag("-v,--verbose", options.verbose, "a line per stage on stderr");
  parser.add_flag("-q,--quiet", options.quiet, "no progress bar, nothing but errors")
      ->excludes(verbose);
}

void declare_quad_options(CLI::App& parser, MeshOptions& options) {
  parser.add_option("--preset", options.preset, preset_help())
      ->check(CLI::IsMember(preset_names()))
      ->capture_default_str();
  parser
      .add_option("--quads", options.quads,
                  "wished number of quads, met within 5 % from 200 up; the preset's by default")
      ->check(whole_number_from(1, kMaxQuads));
  parser.add_flag("--lattice", options.lattice,
                  "a plain axis-aligned lattice instead of the field-aligned mesh");
  parser
      .add_option("--mesh", options.mesh,
                  "what the mesh covers: the whole picture, or its opaque part, with a border that "
                  "follows the outline (alpha 1/2) and its holes; the same for a picture without "
                  "transparency, an error for one without an opaque pixel")
      ->check(CLI::IsMember({"whole", "opaque"}))
      ->capture_default_str();
  parser
      .add_option("--alignment", options.alignment,
                  "how closely the cross field follows features, at the price of singularities: "
                  "about 0.01 to 0.5")
      ->check(positive_number())
      ->check(number_from(0, kMaxAlignment))
      ->capture_default_str();
  parser
      .add_option("--field", options.field,
                  "how the cross field is found: smooth, or paper (its Eq. 1-3 and Alg. 1 as "
                  "printed, for comparison only)")
      ->check(CLI::IsMember({"smooth", "paper"}))
      ->capture_default_str();
  parser
      .add_option("--density", options.density,
                  "picture of any size, stretched over IN: more quads where it is brighter")
      ->check(file_name())
      ->type_name("MAP");
}

void declare_mesh_options(CLI::App& parser, MeshOptions& options) {
  declare_quad_options(parser, options);
  parser
      .add_option("--fit", options.fit,
                  "how colours are found: hermite (values and slopes by least squares over all "
                  "pixels), bessel-ls (values only) or bessel (sampled at the vertices, as in the "
                  "paper)")
      ->check(CLI::IsMember({"bessel", "bessel-ls", "hermite"}))
      ->capture_default_str();
  parser
      .add_option(
          "--tears", options.tears,
          "where colours may jump: auto (along the sharp edges where that lowers the error), "
          "strong (along all of them) or off; the preset's by default")
      ->check(CLI::IsMember({"auto", "off", "strong"}));
  parser
      .add_option("--optimize", options.optimize,
                  "rounds that move the vertices to where they reproduce the picture better, 0 for "
                  "none; without effect on --fit bessel")
      ->check(whole_number_from(0, 1000))
      ->capture_default_str();
  parser.add_flag("--editable", options.editable,
                  "keep the moved quads well-shaped, at the price of a little error");
}

void declare_input(CLI::App& parser, std::filesystem::path& input, const std::string& what) {
  parser.add_option("IN", input, what)->required()->type_name("FILE");
}

void declare_outputs(CLI::App& parser, std::vector<std::filesystem::path>& outputs) {
  parser
      .add_option("-o,--output", outputs,
                  "file to write; its ending chooses the format; may be given several times")
      ->required()
      ->allow_extra_args(false)
      ->type_name("FILE");
}

void declare_output(CLI::App& parser, std::filesystem::path& output, const std::string& what) {
  parser.add_option("-o,--output", output, what + " to write; its ending chooses the format")
      ->required()
      ->type_name("FILE");
}

CLI::Validator file_name() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        return text.empty() ? "the name of the file is empty" : "";
      },
      "", "file name");
}

CLI::Validator positive_number() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        const std::optional<double> value = number_of<double>(text);
        return value && std::isfinite(*value) && *value > 0
                   ? ""
                   : fmt::format("'{}' is not a number above 0", text);
      },
      "POSITIVE", "positive number");
}

CLI::Validator number_from(double low, double high) {
  return within(low, high, "NUMBER", "number");
}

CLI::Validator whole_number_from(int low, int high) {
  return within(low, high, "INT", "whole number");
}

}  // namespace quadrille::cli
