#include "recall_figures.h"

#include <algorithm>
#include <array>

#include "quadrille/image_file.h"
#include "quadrille/vectorize.h"
#include "recall_curve.h"

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kWishedCells = {300, 900, 1500, 2700};  // of the paper's Fig. 12
constexpr std::array kRulers = {10.0f, 20.0f, 40.0f};        // the recommended one first

RecallPoint mesh_point(const QuadMesh& mesh, const Raster& picture,
                       const std::vector<BoundaryMask>& annotations) {
  const BoundaryMask boundary = boundary_of(quad_labels(mesh, picture.width, picture.height));
  return {static_cast<double>(mesh.quad_count()), boundary_score(boundary, annotations)};
}

Json as_json(const RecallPoint& point) {
  return {{"cells", point.cells}, {"recall", point.score.recall}, {"density", point.score.density}};
}

std::vector<RecallCurve> slic_curves(const Raster& picture,
                                     const std::vector<BoundaryMask>& annotations) {
  std::vector<RecallCurve> curves;
  for (const float ruler : kRulers) {
    auto points = slic_points(picture, annotations, ruler);
    if (!points.empty()) curves.emplace_back(std::move(points));
  }
  return curves;
}

void add_slic(Json& row, const std::vector<RecallCurve>& curves, const RecallPoint& ours) {
  if (curves.empty()) return;
  RecallPoint best;
  for (const RecallCurve& curve : curves) {
    const RecallPoint point = curve.at_density(ours.score.density);
    if (point.score.recall > best.score.recall) best = point;
  }
  row["slic"] = as_json(curves.front().at_cells(ours.cells));
  row["slic_density"] = as_json(curves.front().at_density(ours.score.density));
  row["slic_best"] = as_json(best);
}

}  // namespace

Json recall_figures(const std::filesystem::path& path, const std::filesystem::path& drawings,
                    const RecallOptions& options) {
  const Raster picture = load_image(path);
  const auto annotations = load_annotations(drawings, path.stem().string());
  const auto curves = options.slic ? slic_curves(picture, annotations) : std::vector<RecallCurve>{};
  RunContext context;
  context.threads = options.threads;
  Json rows = Json::array();
  for (const int wished : kWishedCells) {
    VectorizeOptions wish;
    wish.quads = wished;
    const QuadMesh mesh = quadrangulate(picture, wish, context).mesh;
    const QuadMesh grid = lattice_mesh(picture.width, picture.height, mesh.quad_count());
    const RecallPoint ours = mesh_point(mesh, picture, annotations);
    Json row = {{"wished", wished},
                {"ours", as_json(ours)},
                {"grid", as_json(mesh_point(grid, picture, annotations))}};
    add_slic(row, curves, ours);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace quadrille::bench
