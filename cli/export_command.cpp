#include <memory>

#include "command.h"
#include "common_options.h"
#include "output_files.h"
#include "quadrille/document.h"

namespace quadrille::cli {
namespace {

struct ExportRequest {
  std::filesystem::path input;
  std::vector<std::filesystem::path> outputs;
  double scale = 1;
  DocumentOptions document;
  SvgOptions svg;
  PdfOptions page;
  RunOptions run;
};

int run_export(const ExportRequest& request) {
  check_outputs(request.outputs, request.input, export_endings());
  Observer observer(request.run.verbosity(), request.run.threads);
  const VectorImage image = observer.stage("read", [&] { return load_document(request.input); });
  ExportOptions options;
  options.raster.scale = request.scale;
  options.document = request.document;
  options.svg = request.svg;
  options.pdf = request.page;
  write_outputs(image, request.outputs, options, observer);
  return kSuccess;
}

}  // namespace

Action declare_export(CLI::App& parser) {
  const auto request = std::make_shared<ExportRequest>();
  declare_input(parser, request->input, ".quad document");
  declare_outputs(parser, request->outputs);
  parser.add_option("--scale", request->scale, "output pixels per source pixel, for pixel formats")
      ->check(positive_number())
      ->capture_default_str();
  declare_document_options(parser, request->document);
  declare_svg_options(parser, request->svg);
  declare_page_options(parser, request->page);
  declare_run_options(parser, request->run);
  return [request] { return run_export(*request); };
}

}  // namespace quadrille::cli
