#include "report.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "picture_input.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"

namespace quadrille::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json stages_of(const Observer& observer) {
  Json stages = Json::array();
  for (const StageReport& stage : observer.stages()) {
    Json figures = Json::object();
    for (const auto& [name, value] : stage.figures) figures[name] = value;
    stages.push_back({{"name", stage.name}, {"seconds", stage.seconds}, {"figures", figures}});
  }
  return stages;
}

Json phases_of(const std::vector<CrossFieldPhase>& phases) {
  Json entries = Json::array();
  for (const CrossFieldPhase& phase : phases) {
    const auto positive = std::ranges::count_if(
        phase.singularities, [](const Singularity& s) { return s.quarter_index > 0; });
    entries.push_back({{"name", phase.name},
                       {"positive", positive},
                       {"negative", std::ssize(phase.singularities) - positive},
                       {"energy", phase.energy},
                       {"misalignment_degrees", phase.misalignment_degrees}});
  }
  return entries;
}

Json preset_of(const ChosenOptions& chosen) {
  Json preset = {{"name", chosen.preset}};
  if (chosen.content) {
    preset["flat_share"] = chosen.content->flat_share;
    preset["main_colors"] = chosen.content->main_colors;
    preset["transparent_share"] = chosen.content->transparent_share;
  }
  return preset;
}

/// Null without a bound.
Json error_bound_of(const RunReport& report) {
  if (!report.max_error) return nullptr;
  Json rounds = Json::array();
  for (const ErrorBoundRound& round : report.rounds) {
    rounds.push_back({{"wished", round.wished_quads}, {"quads", round.quads}, {"mae", round.mae}});
  }
  return {{"wished", *report.max_error},
          {"met", report.measurement.difference.mae <= *report.max_error},
          {"rounds", rounds}};
}

Json sizes_of(const std::vector<fs::path>& outputs) {
  Json files = Json::array();
  for (const fs::path& output : outputs) {
    std::error_code ignored;
    files.push_back({{"file", printable_name(output)}, {"bytes", fs::file_size(output, ignored)}});
  }
  return files;
}

std::string name_of(TearOptions::Mode mode) {
  using Mode = TearOptions::Mode;
  return mode == Mode::off ? "off" : mode == Mode::strong ? "strong" : "auto";
}

double cpu_seconds(const rusage& usage) {
  const auto seconds = [](const timeval& t) { return t.tv_sec + t.tv_usec * 1e-6; };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Json options_of(const RunReport& report, const Observer& observer) {
  return {{"quads", report.chosen.vectorize.quads},
          {"preset", report.options.preset},
          {"fit", report.options.fit},
          {"tears", name_of(report.chosen.vectorize.tears.mode)},
          {"optimize", report.options.optimize},
          {"editable", report.options.editable},
          {"lattice", report.options.lattice},
          {"mesh", report.options.mesh},
          {"alignment", report.options.alignment},
          {"field", report.options.field},
          {"density", printable_name(report.options.density)},
          {"threads", observer.context().threads}};
}

}  // namespace

Measurement measure(const VectorImage& image, const Raster& picture, Observer& observer) {
  return observer.stage("measure", [&] {
    return Measurement{compare(picture, render(image, {}, observer.context())),
                       count_coverage(image, {}, observer.context())};
  });
}

void write_report(const RunReport& report, const Observer& observer, const fs::path& path) {
  const VectorizeReport& v = report.vectorization;
  const ImageDifference& difference = report.measurement.difference;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);

  const Json json = {
      {"version", QUADRILLE_VERSION},
      {"source", printable_name(report.source)},
      {"width", v.width},
      {"height", v.height},
      {"options", options_of(report, observer)},
      {"preset", preset_of(report.chosen)},
      {"error_bound", error_bound_of(report)},
      {"quads", v.quads},
      {"vertices", v.vertices},
      {"irregular_vertices", v.irregular_vertices},
      {"region",
       {{"mesh", v.region == MeshRegion::opaque ? "opaque" : "whole"},
        {"components", v.components},
        {"holes", v.holes},
        {"outline_length", v.outline_length}}},
      {"singularities",
       {{"positive", v.positive_singularities}, {"negative", v.negative_singularities}}},
      {"misalignment_degrees", v.misalignment_degrees},
      {"cross_field", phases_of(v.cross_field_phases)},
      {"tears", {{"chains", v.chains}, {"torn", v.tears}, {"length", v.tear_length}}},
      {"folded", v.folded},
      {"fallback", v.fallback},
      {"uncovered_pixels", report.measurement.coverage.uncovered},
      {"doubly_covered_pixels", report.measurement.coverage.doubly_covered},
      {"fit", {{"iterations", v.fit.iterations}, {"residual", v.fit.residual}}},
      {"optimize",
       {{"rounds", v.optimize.rounds.size()},
        {"accepted", v.optimize.accepted},
        {"mse_before", v.optimize.mse_before},
        {"mse_after", v.optimize.mse_after}}},
      {"mae", difference.mae},
      {"psnr", difference.psnr},
      {"ssim", difference.ssim},
      {"max_error", difference.max_error},
      {"stages", stages_of(observer)},
      {"outputs", sizes_of(report.outputs)},
      {"seconds", report.seconds},
      {"cpu_seconds", cpu_seconds(usage)},
      {"peak_memory_mb", usage.ru_maxrss * 1024 / 1e6},
  };
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";

  write_stream_atomically(path, [&](std::ostream& file) { file << text; });
}

}  // namespace quadrille::cli
