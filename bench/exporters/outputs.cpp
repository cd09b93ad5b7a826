#include "exporters/outputs.h"

#include "quadrille/error.h"
#include "support/run_program.h"

namespace quadrille::bench {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

const Arguments kSvgPrograms = {"chromium", "resvg", "librsvg"};
const Arguments kPdfPrograms = {"splash", "cairo", "mupdf", "ghostscript", "pdfjs"};

void run_program(const Arguments& argv) {
  std::string said;
  if (test::run(argv, &said) != 0) {
    throw Error(ErrorCode::io_failure, "'" + argv.front() + "' failed: " + said);
  }
}

}  // namespace

const std::vector<Output>& all_outputs() {
  using enum Output::Maker;
  static const std::vector<Output> outputs = {
      {"svg compact", ".svg", ours, {"--svg-level", "compact"}, kSvgPrograms},
      {"svg balanced", ".svg", ours, {}, kSvgPrograms},  // the default
      {"svg faithful", ".svg", ours, {"--svg-level", "faithful"}, kSvgPrograms},
      {"svg hybrid", ".svg", ours, {"--svg-level", "hybrid"}, kSvgPrograms},
      {"svg inkscape", ".svg", ours, {"--svg-level", "inkscape"}, {"inkscape"}},
      {"pdf", ".pdf", ours, {}, kPdfPrograms},
      {"vtracer photo", ".svg", vtracer, {"Photo"}, kSvgPrograms},
      {"vtracer poster", ".svg", vtracer, {"Poster"}, kSvgPrograms},
      {"potrace", ".svg", potrace, {}, kSvgPrograms},
  };
  return outputs;
}

bool is_available(const Output& output) {
  switch (output.maker) {
    case Output::Maker::vtracer:
      return has_module("@neplex/vectorizer");
    case Output::Maker::potrace:
      return test::has_program("potrace");
    default:
      // A document that is not there is another failure than arguments that are unknown.
      Arguments argv = {QUADRILLE_COMMAND, "export", "none.quad", "-o", "none" + output.ending};
      argv.insert(argv.end(), output.arguments.begin(), output.arguments.end());
      constexpr int kWrongCommandLine = 2;
      return test::run(argv) != kWrongCommandLine;
  }
}

void make(const Output& output, const OutputSource& source, const fs::path& file) {
  switch (output.maker) {
    case Output::Maker::vtracer:
      return run_program(
          {"node", script("vtracer.mjs"), output.arguments.front(), source.picture, file});
    case Output::Maker::potrace:  // 96 to the inch: a pixel of the picture is one of SVG's
      return run_program({"potrace", "--svg", "-r", "96", "-o", file, source.pixmap});
    default:
      Arguments arguments = {"export", source.document, "-o", file};
      arguments.insert(arguments.end(), output.arguments.begin(), output.arguments.end());
      return run_command(arguments);
  }
}

void run_command(const Arguments& arguments) {
  Arguments argv = {QUADRILLE_COMMAND};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  run_program(argv);
}

}  // namespace quadrille::bench
