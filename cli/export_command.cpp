#include <memory>

#include "command.h"
#include "common_options.h"
#include "export_options.h"
#include "output_files.h"

namespace quadrille::cli {
namespace {

struct ExportRequest {
  std::filesystem::path input;
  std::vector<std::filesystem::path> outputs;
  ExportOptions files;
  RunOptions run;
};

int run_export(const ExportRequest& request) {
  check_outputs(request.outputs, request.input, export_endings());
  Observer observer(request.run.verbosity(), request.run.threads);
  const VectorImage image = observer.stage("read", [&] { return import_image(request.input); });
  write_outputs({image}, request.outputs, request.files, observer);
  return kSuccess;
}

}  // namespace

Action declare_export(CLI::App& parser) {
  const auto request = std::make_shared<ExportRequest>();
  declare_input(parser, request->input, "file of patches: .quad, .vtu or .vtm");
  declare_outputs(parser, request->outputs);
  declare_export_options(parser, request->files);
  declare_run_options(parser, request->run);
  return [request] { return run_export(*request); };
}

}  // namespace quadrille::cli
