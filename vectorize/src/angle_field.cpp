#include "angle_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "parallel.h"

namespace quadrille {
namespace {

// From squared quarter turns to squared radians.
constexpr double kUnit = std::numbers::pi * std::numbers::pi / 4;
// How much more the data weighs beside explicit angles than beside z. Where features conflict, z
// gives way by its length, smoothness weighs less there, and contours are still followed; angles
// cannot, and at equal weight they would give up contours for a few singularities less.
constexpr double kAngleAlignment = 5;
// On the picture's border the cross must be axis-aligned whatever the picture shows.
constexpr float kBorderMass = 10;
// Keeps the system regular where nothing pulls at all; far below any data weight.
constexpr float kTinyMass = 1e-7f;

/// arg(z) / (2 pi). The polynomial of Abramowitz and Stegun 4.4.49, good to 2e-8, because a loop
/// over std::arg takes as long as a multigrid cycle.
void quarter_turns(const std::complex<float>* z, float* turns, int count) {
  constexpr std::array<float, 8> kSeries = {-0.3333314528f, 0.1999355085f,  -0.1420889944f,
                                            0.1065626393f,  -0.0752896400f, 0.0429096138f,
                                            -0.0161657367f, 0.0028662257f};
  constexpr float kPerRadian = static_cast<float>(0.5 / std::numbers::pi);
  const auto* parts = reinterpret_cast<const float*>(z);
  for (int i = 0; i < count; ++i) {
    const float re = parts[2 * i], im = parts[2 * i + 1];
    const float a = std::abs(re), b = std::abs(im);
    const float large = a > b ? a : b, small = a > b ? b : a;
    const float t = small / (large + 1e-30f), t2 = t * t;
    float sum = kSeries[7];
    for (int k = 6; k >= 0; --k) sum = sum * t2 + kSeries[k];
    // Reflections at 45, 90 and 180 degrees without branches, so that the loop vectorises.
    const float octant = kPerRadian * (t + t * t2 * sum);
    const float quadrant = 0.125f - std::copysign(0.125f - octant, a - b);
    const float half = 0.25f - std::copysign(0.25f - quadrant, re);
    turns[i] = std::copysign(half, im);
  }
}

/// Sums terms in a fixed order that vectorises: eight lanes, then the lanes.
class LaneSum {
 public:
  template <class Term>
  void add(int first, int last, const Term& term) {
    int k = first;
    for (; k + 8 <= last; k += 8) {
      for (int lane = 0; lane < 8; ++lane) lanes_[lane] += term(k + lane);
    }
    for (; k < last; ++k) lanes_[0] += term(k);
  }
  double total() const {
    double sum = 0;
    for (float lane : lanes_) sum += lane;
    return sum;
  }

 private:
  std::array<float, 8> lanes_{};
};

float square(float a) { return a * a; }

/// The data terms and the edges to the left of the window's row y, and its edges upward; at the
/// window's far sides also the edges that leave it.
double row_energy(const AngleField& field, const Window& window, int y) {
  const int w = field.turns.width, h = field.turns.height;
  const float* u = &field.turns(0, y);
  const float *target = &field.target(0, y), *mass = &field.mass(0, y);
  LaneSum sum;
  sum.add(window.x0, window.x1,
          [=](int x) { return mass[x] * square(principal(u[x] - target[x])); });
  sum.add(std::max(window.x0, 1), std::min(window.x1 + 1, w),
          [=](int x) { return square(principal(u[x] - u[x - 1])); });
  const auto vertical = [&](const float* other) {
    sum.add(window.x0, window.x1, [=](int x) { return square(principal(u[x] - other[x])); });
  };
  if (y > 0) vertical(u - w);
  if (y + 1 == window.y1 && y + 1 < h) vertical(u + w);
  return sum.total();
}

}  // namespace

DataTerm data_term(const FeatureTensor& features, double alignment) {
  const int w = features.weight.width, h = features.weight.height;
  const float lambda = static_cast<float>(alignment);
  DataTerm term{FieldGrid<float>(w, h), ComplexGrid(w, h)};
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const bool border = x == 0 || y == 0 || x + 1 == w || y + 1 == h;
      const float mass = border ? kBorderMass : lambda * features.weight(x, y) + kTinyMass;
      term.mass(x, y) = mass;
      term.pull(x, y) = mass * (border ? std::complex<float>(1) : features.direction(x, y));
    }
  }
  for (const OutlinePixel& p : features.outline) {
    term.mass(p.x, p.y) = kBorderMass;
    term.pull(p.x, p.y) = kBorderMass * p.cross();
  }
  return term;
}

void set_turns(const ComplexGrid& z, AngleField& field, const RunContext& context) {
  parallel_rows(context, z.height, z.width,
                [&](int y) { quarter_turns(&z(0, y), &field.turns(0, y), z.width); });
}

AngleField angle_field(const FeatureTensor& features, double alignment, const RunContext& context) {
  DataTerm data = data_term(features, kAngleAlignment * alignment);
  const int w = data.mass.width, h = data.mass.height;
  AngleField field{FieldGrid<float>(w, h), FieldGrid<float>(w, h), std::move(data.mass)};
  parallel_rows(context, h, w,
                [&](int y) { quarter_turns(&data.pull(0, y), &field.target(0, y), w); });
  return field;
}

std::complex<float> from_turns(float turns) {
  return std::polar(1.0f, static_cast<float>(2 * std::numbers::pi) * turns);
}

double energy(const AngleField& field, const Window& window) {
  double sum = 0;
  for (int y = window.y0; y < window.y1; ++y) sum += row_energy(field, window, y);
  return kUnit * sum;
}

double energy(const AngleField& field, const RunContext& context) {
  const Window all{0, 0, field.turns.width, field.turns.height};
  std::vector<double> rows(all.y1);
  parallel_rows(context, all.y1, all.x1, [&](int y) { rows[y] = row_energy(field, all, y); });
  double sum = 0;
  for (double row : rows) sum += row;
  return kUnit * sum;
}

int quarter_index(const FieldGrid<float>& u, int x, int y) {
  const float a = u(x, y), b = u(x + 1, y), c = u(x + 1, y + 1), d = u(x, y + 1);
  const float turn = (principal(b - a) + principal(c - b)) - (principal(c - d) + principal(d - a));
  return static_cast<int>(std::lround(turn));
}

}  // namespace quadrille
