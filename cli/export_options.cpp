#include "export_options.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "common_options.h"
#include "gltf_options.h"

namespace quadrille::cli {
namespace {

void declare_svg_options(CLI::App& parser, SvgOptions& options) {
  static const std::map<std::string, SvgLevel> kLevels = {{"compact", SvgLevel::compact},
                                                          {"balanced", SvgLevel::balanced},
                                                          {"faithful", SvgLevel::faithful},
                                                          {"hybrid", SvgLevel::hybrid},
                                                          {"inkscape", SvgLevel::inkscape}};
  parser
      .add_option_function<std::string>(
          "--svg-level", [&](const std::string& name) { options.level = kLevels.at(name); },
          "how closely .svg files show the picture, at the price of their size: compact, balanced "
          "or faithful; or hybrid: pixel images behind exact outlines; or inkscape: mesh gradients "
          "to edit in Inkscape, of which other programs show flat colours")
      ->check(CLI::IsMember({"compact", "balanced", "faithful", "hybrid", "inkscape"}))
      ->default_str("balanced");
  parser
      .add_option_function<double>(
          "--svg-size-limit",
          [&](double kilobytes) {
            options.size_limit = static_cast<std::uint64_t>(std::llround(1000 * kilobytes));
          },
          "most size of .svg and .svgz files in KB (1000 bytes) as written; searches the colour "
          "tolerance that fits")
      ->check(number_from(1, 1e9))
      ->type_name("KB");
}

}  // namespace

void declare_export_options(CLI::App& parser, ExportOptions& options) {
  parser
      .add_option("--scale", options.raster.scale,
                  "output pixels per source pixel, for pixel formats")
      ->check(positive_number())
      ->capture_default_str();
  parser.add_flag_callback(
      "--lossless", [&] { options.document.encoding = DocumentEncoding::lossless; },
      "write .quad documents bit for bit, some 15 times larger");
  declare_svg_options(parser, options.svg);
  parser
      .add_option("--dpi", options.pdf.dpi,
                  "pixels of the picture per inch of the page, for .pdf, .ps and .eps")
      ->check(number_from(1, 10000))
      ->capture_default_str();
  parser
      .add_option("--pdf-tolerance", options.pdf.tolerance,
                  "colour error of .pdf, .ps and .eps in steps of 255, at the price of their size")
      ->check(number_from(0.5, 64))
      ->type_name("T")
      ->capture_default_str();
  declare_gltf_options(parser, options.gltf);
  parser
      .add_option("--vtk-divisions", options.vtk.divisions,
                  "quads per side of a patch in .vtp files")
      ->check(whole_number_from(1, 64))
      ->capture_default_str();
  parser.parse_complete_callback([&options] {
    const SvgLevel level = options.svg.level;
    const bool has_tolerance = level != SvgLevel::hybrid && level != SvgLevel::inkscape;
    if (has_tolerance || options.svg.size_limit == 0) return;
    throw CLI::ValidationError(
        "--svg-size-limit",
        "has nothing to choose at --svg-level hybrid and inkscape; leave one out");
  });
}

}  // namespace quadrille::cli
