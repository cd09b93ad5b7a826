#include "exporters/drawing_program.h"

#include <algorithm>
#include <fstream>

#include "program.h"
#include "quadrille/error.h"
#include "support/run_program.h"

namespace quadrille::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const fs::path kPrograms = fs::path(QUADRILLE_SOURCE_DIR) / "bench/programs";

}  // namespace

bool is_available(const DrawingProgram& program) {
  return test::has_program("node") && std::ranges::all_of(program.commands, test::has_program) &&
         std::ranges::all_of(program.modules, has_module);
}

const std::vector<DrawingProgram>& drawing_programs() {
  static const std::vector<DrawingProgram> programs = {
      {"chromium", {"chromium"}, {"playwright-core"}},
      {"resvg", {}, {"@resvg/resvg-js"}},
      {"librsvg", {"rsvg-convert"}, {}},
      {"inkscape", {"inkscape"}, {}},
      {"splash", {"pdftoppm"}, {}},
      {"cairo", {"pdftocairo"}, {}},
      {"mupdf", {"mutool"}, {}},
      {"ghostscript", {"gs"}, {}},
      {"pdfjs", {"chromium"}, {"playwright-core", "pdfjs-dist"}},
  };
  return programs;
}

std::vector<Json> draw(const DrawingProgram& program, const std::vector<DrawingJob>& jobs,
                       const fs::path& scratch_folder) {
  Json list = Json::array();
  for (const DrawingJob& job : jobs) {
    list.push_back({{"file", job.file},
                    {"picture", job.picture},
                    {"width", job.width},
                    {"height", job.height},
                    {"scale", job.scale}});
  }
  const fs::path wishes = scratch_folder / "jobs.json", answers = scratch_folder / "results.json";
  std::string said;
  if (!write_json(list, wishes) ||
      test::run({"node", script("draw.mjs"), program.name, wishes, answers}, &said) != 0) {
    throw Error(ErrorCode::io_failure, "'" + program.name + "' does not draw: " + said);
  }
  std::ifstream file(answers);
  return Json::parse(file).get<std::vector<Json>>();
}

std::string script(const std::string& name) { return kPrograms / name; }

bool has_module(const std::string& name) { return fs::exists(kPrograms / "node_modules" / name); }

}  // namespace quadrille::bench
