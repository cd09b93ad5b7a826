#include "pdf_region_path.h"

#include <cmath>

#include "subdivision.h"
#include "svg_text.h"

namespace quadrille {
namespace {

/// Farthest that a line may lie from the curve it stands for, in pixels.
constexpr double kFlatness = 0.01;

class PathText {
 public:
  PathText(const Layer& layer, int units) : layer_(layer), units_(units) {}

  void add_loop(const EdgeLoop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const PlaneCurve curve = edge_curve(layer_, loop[i]);
      if (i == 0) point(curve[0], "m");
      const bool closes = i + 1 == loop.size();
      if (!closes || is_curved(curve)) go_along(curve);
    }
    text_ += "h\n";
  }

  void add_edge(int h) {
    const PlaneCurve curve = edge_curve(layer_, h);
    point(curve[0], "m");
    go_along(curve);
  }

  const std::string& text() const { return text_; }

 private:
  static bool is_curved(const PlaneCurve& curve) { return chord_distance(curve) > kFlatness; }

  void go_along(const PlaneCurve& curve) {
    if (is_curved(curve)) {
      point(curve[1], "");
      point(curve[2], "");
    }
    point(curve[3], is_curved(curve) ? "c" : "l");
  }

  void point(const Eigen::Vector2d& p, const char* operation) {
    text_ += number(p.x()) + ' ' + number(p.y()) + ' ';
    text_ += operation;
    if (*operation) text_ += '\n';
  }

  std::string number(double pixel) const { return to_text(std::llround(pixel * units_)); }

  const Layer& layer_;
  int units_;
  std::string text_;
};

}  // namespace

std::string region_path(const Layer& layer, const std::vector<EdgeLoop>& loops, int units) {
  PathText path(layer, units);
  for (const EdgeLoop& loop : loops) path.add_loop(loop);
  return path.text();
}

std::string edges_path(const Layer& layer, const std::vector<int>& halfedges, int units) {
  PathText path(layer, units);
  for (const int h : halfedges) path.add_edge(h);
  return path.text();
}

}  // namespace quadrille
