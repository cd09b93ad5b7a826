#include "field_phases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "quadrille/local_angle_smoothing.h"

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Misalignment falls along the ladder.
constexpr std::array kAlignments = {0.05, 0.1, 0.2, 0.4, 0.8, 1.6};

struct LocalKind {
  const char* name;
  int sweeps;
  bool hierarchical;
};
/// Sweeps over each level of a hierarchy as Instant Meshes does them; without one, as many as still
/// change the field.
constexpr std::array kLocalKinds = {LocalKind{"local, one level", 60, false},
                                    LocalKind{"local, hierarchical", 6, true}};

Json as_json(const CrossFieldPhase& phase) {
  return {{"singularities", phase.singularities.size()},
          {"misalignment", phase.misalignment_degrees},
          {"energy", phase.energy}};
}

Json local_figures(const FeatureTensor& features) {
  Json local = Json::object();
  for (const LocalKind& kind : kLocalKinds) {
    for (const double alignment : kAlignments) {
      const CrossField field =
          local_angle_smoothing(features, {alignment, kind.sweeps, kind.hierarchical});
      local[kind.name].push_back(as_json(field.phases.back()));
    }
  }
  return local;
}

double mean_at(const std::vector<TableRow>& rows, const Json::json_pointer& at) {
  return mean(values(rows, {"", at.to_string()}));
}

/// A place on the ladder, between two of its steps.
struct Step {
  std::size_t index = 0;
  double part = 0;  ///< of the way to the next one

  double between(double here, double next) const { return here + part * (next - here); }
};

/// Where the falling figures come closest to `wished`.
Step find_step(const std::vector<double>& figures, double wished) {
  std::size_t i = 0;
  while (i + 2 < figures.size() && figures[i + 1] > wished) ++i;
  const double fall = figures[i] - figures[i + 1];
  const double part = fall > 0 ? (figures[i] - wished) / fall : 0;
  return {i, std::clamp(part, 0.0, 1.0)};
}

Json interpolated(const Json& ladder, const Step& step) {
  const auto at = [&](const char* figure) {
    return step.between(ladder[step.index][figure].get<double>(),
                        ladder[step.index + 1][figure].get<double>());
  };
  const double alignment = std::exp(
      step.between(std::log(kAlignments[step.index]), std::log(kAlignments[step.index + 1])));
  return {{"singularities", at("singularities")},
          {"misalignment", at("misalignment")},
          {"alignment", alignment}};
}

}  // namespace

Json field_figures(const Quadrangulation& quads) {
  Json figures = Json::object();
  if (quads.cross.z.data.empty()) return figures;  // the lattice
  for (const CrossFieldPhase& phase : quads.cross.phases) {
    figures["phases"][phase.name] = as_json(phase);
  }
  figures["local"] = local_figures(quads.features);
  return figures;
}

void match_local_smoothing(std::vector<TableRow>& rows) {
  const Json::json_pointer finished("/fields/phases/cancelled/misalignment");
  const double wished = mean_at(rows, finished);
  if (!std::isfinite(wished)) return;
  for (const LocalKind& kind : kLocalKinds) {
    const Json::json_pointer ladder = Json::json_pointer("/fields/local") / kind.name;
    std::vector<double> misalignment;
    for (std::size_t i = 0; i < kAlignments.size(); ++i) {
      misalignment.push_back(mean_at(rows, ladder / i / "misalignment"));
    }
    const Step step = find_step(misalignment, wished);
    for (TableRow& row : rows) {
      if (!row.json.contains(ladder)) continue;
      row.json["fields"]["phases"][kind.name] = interpolated(row.json.at(ladder), step);
    }
  }
}

}  // namespace quadrille::bench
