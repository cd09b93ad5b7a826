#include "exporters/picture_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "exporters/drawing_figures.h"
#include "fit/on_white.h"
#include "gzip_size.h"
#include "own_process.h"
#include "quadrille/document.h"
#include "quadrille/error.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "quadrille/render.h"
#include "scratch_folder.h"

namespace quadrille::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kRivalsReference = "resvg";

void write_pixmap(const Raster& picture, const fs::path& path) {
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << picture.width << ' ' << picture.height << "\n255\n";
  for (const float sample : on_white(picture).data) {
    file.put(static_cast<char>(static_cast<unsigned char>(sample * 255 + 0.5f)));
  }
}

class PictureMeasurement {
 public:
  PictureMeasurement(const fs::path& picture, const ExporterRun& run)
      : run_(run), picture_(load_image(picture)) {
    context_.threads = run.threads;
    source_ = {fs::absolute(picture), folder_.path / "picture.ppm", folder_.path / "picture.quad"};
    write_pixmap(picture_, source_.pixmap);
    run_command({"vectorize", source_.picture, "--quads", std::to_string(run.quads), "--threads",
                 std::to_string(run.threads), "-q", "-o", source_.document});
    image_ = load_document(source_.document);
  }

  Json measure() {
    Json figures = {{"width", picture_.width},
                    {"height", picture_.height},
                    {"quads", image_.patch_count()},
                    {"outputs", Json::object()}};
    for (const Output& output : run_.outputs) {
      make(output, source_, file_of(output));
      figures["outputs"][output.name] = {{"bytes", fs::file_size(file_of(output))},
                                         {"gzip", gzip_size(file_of(output))}};
    }
    for (const DrawingProgram& program : run_.programs) draw_all(program, figures["outputs"]);
    for (const int scale : kDrawingScales) compare_all(scale, figures["outputs"]);
    return figures;
  }

 private:
  struct Drawing {
    const Output* output;
    std::string program;
    int scale;
  };

  fs::path file_of(const Output& output) const {
    return folder_.path / (output.name + output.ending);
  }
  fs::path drawing_of(const Drawing& drawing) const {
    return folder_.path /
           fmt::format("{} {} {}.png", drawing.output->name, drawing.program, drawing.scale);
  }
  static Json::json_pointer place_of(const Drawing& drawing) {
    return Json::json_pointer() / drawing.output->name / "programs" / drawing.program;
  }

  /// Lets the program draw what it should, and notes what that took or why it failed.
  void draw_all(const DrawingProgram& program, Json& figures) {
    std::vector<Drawing> drawings;
    std::vector<DrawingJob> jobs;
    for (const Output& output : run_.outputs) {
      if (std::ranges::find(output.programs, program.name) == output.programs.end()) continue;
      for (const int scale : kDrawingScales) {
        drawings.push_back({&output, program.name, scale});
        jobs.push_back({file_of(output), drawing_of(drawings.back()), picture_.width * scale,
                        picture_.height * scale, double(scale)});
      }
    }
    if (jobs.empty()) return;
    const std::vector<Json> results = draw(program, jobs, folder_.path);
    for (std::size_t i = 0; i < results.size(); ++i) {
      Json& mine = figures[place_of(drawings[i])];
      if (results[i].contains("error")) {
        mine["error"] = results[i]["error"];
      } else {
        mine[std::to_string(drawings[i].scale)] = results[i];
        drawings_.push_back(drawings[i]);
      }
    }
  }

  void compare_all(int scale, Json& figures) const {
    const Raster ours = render(image_, {.scale = double(scale)}, context_);
    std::map<const Output*, Raster> rivals;
    for (const Drawing& drawing : drawings_) {
      if (drawing.scale != scale || drawing.output->is_ours()) continue;
      if (drawing.program == kRivalsReference) {
        rivals[drawing.output] = load_image(drawing_of(drawing));
      }
    }
    for (const Drawing& drawing : drawings_) {
      if (drawing.scale != scale) continue;
      const Raster drawn = load_image(drawing_of(drawing));
      Json& mine = figures[place_of(drawing)];
      if (scale == 1) mine["source_psnr"] = compare(picture_, drawn).psnr;
      const bool is_ours = drawing.output->is_ours();
      if (!is_ours && drawing.program == kRivalsReference) continue;
      if (!is_ours && !rivals.contains(drawing.output)) continue;
      mine[std::to_string(scale)].update(
          drawing_figures(is_ours ? ours : rivals.at(drawing.output), drawn));
    }
  }

  const ExporterRun& run_;
  RunContext context_;
  ScratchFolder folder_;
  Raster picture_;
  OutputSource source_;
  VectorImage image_;
  std::vector<Drawing> drawings_;
};

}  // namespace

Json exporter_figures(const fs::path& picture, const ExporterRun& run) {
  return run_in_own_process([&] { return PictureMeasurement(picture, run).measure(); });
}

}  // namespace quadrille::bench
