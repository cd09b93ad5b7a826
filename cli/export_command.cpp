#include <algorithm>
#include <memory>

#include "command.h"
#include "common_options.h"
#include "export_options.h"
#include "output_files.h"
#include "picture_input.h"

namespace quadrille::cli {
namespace {

struct ExportRequest {
  std::filesystem::path input;
  std::filesystem::path source;  // empty: the one that the input keeps, if it does
  std::vector<std::filesystem::path> outputs;
  ExportOptions files;
  RunOptions run;
};

bool holds_errors(const std::filesystem::path& output) {
  return ending_of(output) == ".vtu" || ending_of(output) == ".vtm";
}

int run_export(const ExportRequest& request) {
  const bool needs_source = std::ranges::any_of(request.outputs, holds_errors);
  if (!request.source.empty() && !needs_source) {
    throw UsageError(
        "--source is for .vtm and .vtu outputs, which hold the error; leave it out; see 'quadrille "
        "help export'");
  }
  check_outputs(request.outputs, {request.input, request.source}, export_endings());
  Observer observer(request.run.verbosity(), request.run.threads);
  const VectorImage image = observer.stage("read", [&] { return import_image(request.input); });
  for (const std::filesystem::path& output : request.outputs) {
    check_size(image.width, image.height, request.files.raster, output);
  }
  std::shared_ptr<const Raster> source;
  if (needs_source) source = read_source(request.input, request.source, image, observer);
  write_outputs({image, {source.get(), nullptr}}, request.outputs, request.files, observer);
  return kSuccess;
}

}  // namespace

Action declare_export(CLI::App& parser) {
  const auto request = std::make_shared<ExportRequest>();
  declare_input(parser, request->input, "file of patches: .quad, .vtu or .vtm");
  declare_outputs(parser, request->outputs);
  parser
      .add_option(
          "--source", request->source,
          "the picture that the patches were made of, for its error in .vtm and .vtu files; "
          "a .vtm keeps it")
      ->check(file_name())
      ->type_name("PICTURE");
  declare_export_options(parser, request->files);
  declare_run_options(parser, request->run);
  return [request] { return run_export(*request); };
}

}  // namespace quadrille::cli
