#include "baseline.h"

#include <cmath>
#include <fstream>
#include <map>

#include "quadrille/error.h"

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Where the stored figures stand in a row.
const std::map<std::string, Json::json_pointer> kStored = {
    {"quads", Json::json_pointer("/front/quads")},
    {"mae", Json::json_pointer("/ours/mae")},
    {"irregular", Json::json_pointer("/shape/irregular")},
    {"jacobian_min", Json::json_pointer("/shape/jacobian_min")},
    {"ratio", Json::json_pointer("/front/ratio")},
};

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

}  // namespace

void add_baseline(std::vector<TableRow>& rows, const std::filesystem::path& file, int quads) {
  std::ifstream stream(file);
  const Json baseline = Json::parse(stream, nullptr, /*allow_exceptions=*/false);
  if (baseline.is_discarded()) {
    throw Error(ErrorCode::io_failure, file.string() + " holds no readable baseline");
  }
  if (baseline.at("quads") != quads) return;
  const Json& pictures = baseline.at("pictures");
  for (TableRow& row : rows) {
    if (!pictures.contains(row.name)) continue;
    Json& stored = row.json["baseline"] = pictures.at(row.name);
    stored["ratio_change"] =
        row.json["front"]["ratio"].get<double>() / stored["ratio"].get<double>();
  }
}

void write_baseline(const std::vector<TableRow>& rows, const std::filesystem::path& file,
                    int quads) {
  Json baseline = {{"quads", quads}, {"pictures", Json::object()}};
  for (const TableRow& row : rows) {
    Json& stored = baseline["pictures"][row.name];
    for (const auto& [name, at] : kStored) stored[name] = rounded(row.json.at(at).get<double>());
  }
  std::ofstream stream(file);
  stream << baseline.dump(1) << '\n';
  if (!stream.flush()) throw Error(ErrorCode::io_failure, "cannot write " + file.string());
}

}  // namespace quadrille::bench
