#include "output_files.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>

#include "quadrille/error.h"
#include "quadrille/left_out_formats.h"
#include "quadrille/metrics.h"
#include "quadrille/picture_layers.h"
#include "quadrille/render.h"

namespace quadrille::cli {
namespace {

namespace fs = std::filesystem;

void check_output(const fs::path& output, const std::vector<fs::path>& inputs,
                  const std::vector<std::string>& endings) {
  const std::string ending = ending_of(output);
  if (std::ranges::find(endings, ending) == endings.end()) {
    throw Error(ErrorCode::unsupported_format,
                fmt::format("cannot write '{}': {}; use one of {}", output.string(),
                            why_unknown(ending), fmt::join(endings, " ")));
  }
  std::error_code ignored;
  const fs::path folder = output.has_parent_path() ? output.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw Error(ErrorCode::io_failure,
                fmt::format("cannot write '{}': there is no folder '{}'; make it first",
                            output.string(), folder.string()));
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::io_failure,
                fmt::format("cannot write '{}': no permission to write into '{}'; choose another "
                            "folder",
                            output.string(), folder.string()));
  }
  if (fs::is_directory(output, ignored)) {
    throw Error(
        ErrorCode::io_failure,
        fmt::format("cannot write '{}': it is a folder; give a file name", output.string()));
  }
  for (const fs::path& input : inputs) {
    if (!fs::equivalent(output, input, ignored)) continue;
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format("'{}' would overwrite the input; choose another name", output.string()));
  }
}

std::string readable_size(std::uintmax_t bytes) {
  if (bytes < 1000) return fmt::format("{} bytes", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", bytes / 1e3);
  return fmt::format("{:.1f} MB", bytes / 1e6);
}

}  // namespace

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

void check_outputs(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs,
                   const std::vector<std::string>& endings) {
  std::vector<fs::path> seen;
  for (const fs::path& output : outputs) {
    check_output(output, inputs, endings);
    const fs::path plain = fs::absolute(output).lexically_normal();
    if (std::ranges::find(seen, plain) != seen.end()) {
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("'{}' is named twice as an output; name it once", output.string()));
    }
    seen.push_back(plain);
  }
}

void check_size(double image_width, double image_height, const RasterFileOptions& options,
                const fs::path& output) {
  if (std::ranges::find(kRasterEndings, ending_of(output)) == kRasterEndings.end()) return;
  VectorImage empty;
  empty.width = image_width;
  empty.height = image_height;
  try {
    output_size(empty, {.scale = options.scale, .width = options.width});
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("cannot write '{}': {}", output.string(), error.what()));
  }
}

void write_outputs(const OutputImage& output, const std::vector<fs::path>& paths,
                   ExportOptions options, Observer& observer) {
  const auto& [image, origin] = output;
  if (const auto title = image.metadata.find("title"); title != image.metadata.end()) {
    options.svg.title = options.pdf.title = title->second;
  }
  for (const fs::path& path : paths) {
    observer.stage("write " + ending_of(path), [&] {
      const RunContext& context = observer.context();
      if (ending_of(path) == ".vtm") {
        export_scene(scene_of(image, origin, context), path, context);
        return;
      }
      if (ending_of(path) == ".vtu" && origin.picture) {
        const SceneLayer error = error_layer(*origin.picture, render(image, {}, context));
        options.vtk.patch_errors = patch_errors(image, std::get<SceneGrid>(error.content));
      }
      if (ending_of(path) == ".quad" && origin.picture) {
        options.document.error =
            document_error(compare(*origin.picture, render(image, {}, context)).mae);
      }
      export_image(image, path, options, context);
    });
    tell_written(path, observer);
  }
}

void tell_written(const fs::path& path, Observer& observer) {
  std::error_code failed;
  const std::uintmax_t bytes = fs::file_size(path, failed);
  if (!failed) observer.tell(fmt::format("{}: {}", path.string(), readable_size(bytes)));
}

}  // namespace quadrille::cli
