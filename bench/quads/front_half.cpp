#include "front_half.h"

#include <algorithm>
#include <limits>

#include "process_cost.h"

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Collects the CPU seconds between the reports of finished stages.
class StageCost {
 public:
  void finish(const std::string& stage) {
    const double now = cpu_seconds();
    stages_[stage] = stages_.value(stage, 0.0) + now - last_;
    last_ = now;
  }
  double total() const { return last_ - start_; }
  const Json& stages() const { return stages_; }

 private:
  Json stages_ = Json::object();
  double start_ = cpu_seconds();
  double last_ = start_;
};

}  // namespace

FrontHalf measure_front_half(const Raster& picture, const FrontHalfOptions& options) {
  VectorizeOptions wish;
  wish.quads = options.quads;
  FrontHalf result;
  double reference = std::numeric_limits<double>::infinity();
  double cpu = std::numeric_limits<double>::infinity();
  for (int run = 0; run < options.runs; ++run) {
    reference = std::min(reference, reference_work_seconds());
    StageCost cost;
    RunContext context;
    context.threads = options.threads;
    context.on_stage = [&](const StageReport& stage) { cost.finish(stage.name); };
    result.quads = quadrangulate(picture, wish, context);
    cost.finish("rest");
    if (cost.total() >= cpu) continue;
    cpu = cost.total();
    result.figures["stages"] = cost.stages();
  }
  const int quads = result.quads.mesh.quad_count();
  result.figures.update({{"width", picture.width},
                         {"height", picture.height},
                         {"wished", options.quads},
                         {"quads", quads},
                         {"count_error", static_cast<double>(quads) / options.quads - 1},
                         {"cpu", cpu},
                         {"ratio", cpu / reference}});
  if (result.quads.fallback) result.figures["fallback"] = "fallback";
  return result;
}

}  // namespace quadrille::bench
