#include "quadrille/cross_field.h"

#include <cmath>
#include <numbers>

#include "grid_solver.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using Complex = std::complex<float>;

// On the picture's border the cross must be axis-aligned whatever the picture shows.
constexpr float kBorderMass = 10;
// Keeps the system regular where nothing pulls at all; far below any data weight.
constexpr float kTinyMass = 1e-7f;
constexpr double kTolerance = 1e-3;
constexpr int kMaxIterations = 40;

struct DataTerm {
  FieldGrid<float> mass;
  ComplexGrid pull;  // mass times target
};

DataTerm data_term(const FeatureTensor& features, double alignment) {
  const int w = features.weight.width, h = features.weight.height;
  DataTerm term{FieldGrid<float>(w, h), ComplexGrid(w, h)};
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const bool border = x == 0 || y == 0 || x + 1 == w || y + 1 == h;
      const float mass =
          border ? kBorderMass : static_cast<float>(alignment) * features.weight(x, y) + kTinyMass;
      term.mass(x, y) = mass;
      term.pull(x, y) = border ? Complex(mass) : mass * features.direction(x, y);
    }
  }
  for (const OutlinePixel& p : features.outline) {
    term.mass(p.x, p.y) = kBorderMass;
    term.pull(p.x, p.y) = kBorderMass * p.cross();
  }
  return term;
}

Complex unit(Complex z) {
  const float length = std::abs(z);
  return length > 1e-20f ? z / length : Complex(1);
}

}  // namespace

CrossField cross_field(const FeatureTensor& features, const CrossFieldOptions& options,
                       const RunContext& context) {
  if (!(options.alignment > 0) || !(options.renormalizing_weight > 0)) {
    throw Error(ErrorCode::invalid_argument,
                "the cross field's weights must be positive; use an alignment such as 0.05");
  }
  const DataTerm term = data_term(features, options.alignment);
  CrossField field{term.pull, term.mass};
  for (Complex& z : field.z.data) z = unit(z);
  GridSolver(term.mass, context).solve(term.pull, field.z, kTolerance, kMaxIterations);

  const float mu = static_cast<float>(options.renormalizing_weight);
  FieldGrid<float> mass = term.mass;
  for (float& m : mass.data) m += mu;
  const GridSolver pulled(mass, context);
  for (int round = 0; round < options.renormalizing_rounds; ++round) {
    context.progress("cross field", (round + 1.0) / (options.renormalizing_rounds + 1));
    ComplexGrid b = term.pull;
    for (std::size_t i = 0; i < b.data.size(); ++i) b.data[i] += mu * unit(field.z.data[i]);
    pulled.solve(b, field.z, kTolerance, kMaxIterations);
  }
  for (std::size_t i = 0; i < field.z.data.size(); ++i) {
    field.confidence.data[i] = std::min(1.0f, std::abs(field.z.data[i]));
    field.z.data[i] = unit(field.z.data[i]);
  }
  return field;
}

std::vector<Singularity> singularities(const CrossField& field) {
  std::vector<Singularity> found;
  const auto turn = [](Complex from, Complex to) { return std::arg(to * std::conj(from)); };
  for (int y = 0; y + 1 < field.z.height; ++y) {
    for (int x = 0; x + 1 < field.z.width; ++x) {
      const Complex a = field.z(x, y), b = field.z(x + 1, y), c = field.z(x + 1, y + 1),
                    d = field.z(x, y + 1);
      const double turns =
          (turn(a, b) + turn(b, c) + turn(c, d) + turn(d, a)) / (2 * std::numbers::pi);
      const int index = static_cast<int>(std::lround(turns));
      if (index != 0) found.push_back({x + 1.0, y + 1.0, index});
    }
  }
  return found;
}

double misalignment_degrees(const CrossField& field, const FeatureTensor& features) {
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < field.z.data.size(); ++i) {
    if (!features.edges.data[i]) continue;
    const double w = features.weight.data[i];
    sum += w * std::abs(std::arg(field.z.data[i] * std::conj(features.direction.data[i]))) / 4;
    weight += w;
  }
  return weight > 0 ? sum / weight * 180 / std::numbers::pi : 0;
}

}  // namespace quadrille
