#include "window_solve.h"

namespace quadrille {
namespace {

// Windows are small and the start is close: each cycle shrinks the error about tenfold.
constexpr int kCycles = 3;
// Rounds after the first take up the jumps that the angles have outgrown.
constexpr int kRounds = 2;

/// The data term's weight, and the fixed neighbours' on the window's rim.
FieldGrid<float> window_mass(const AngleField& field, const Window& window) {
  FieldGrid<float> mass(window.width(), window.height());
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const int fixed = (x == window.x0 && x > 0) + (y == window.y0 && y > 0) +
                        (x + 1 == window.x1 && x + 1 < field.mass.width) +
                        (y + 1 == window.y1 && y + 1 < field.mass.height);
      mass(x - window.x0, y - window.y0) = field.mass(x, y) + static_cast<float>(fixed);
    }
  }
  return mass;
}

/// Minus half the energy's gradient over the angles, in quarter turns.
FieldGrid<float> downhill(const AngleField& field, const Window& window) {
  const FieldGrid<float>& u = field.turns;
  FieldGrid<float> slope(window.width(), window.height());
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const float here = u(x, y);
      float sum = field.mass(x, y) * principal(field.target(x, y) - here);
      if (x > 0) sum += principal(u(x - 1, y) - here);
      if (x + 1 < u.width) sum += principal(u(x + 1, y) - here);
      if (y > 0) sum += principal(u(x, y - 1) - here);
      if (y + 1 < u.height) sum += principal(u(x, y + 1) - here);
      slope(x - window.x0, y - window.y0) = sum;
    }
  }
  return slope;
}

}  // namespace

void solve_window(AngleField& field, const Window& window, std::span<const JumpChange> changes,
                  const RunContext& context) {
  GridSolver<float> solver(window_mass(field, window), context);
  for (int round = 0; round < kRounds; ++round) {
    FieldGrid<float> slope = downhill(field, window);
    const auto pull = [&](int x, int y, float change) {
      if (x < window.x0 || y < window.y0 || x >= window.x1 || y >= window.y1) return;
      slope(x - window.x0, y - window.y0) += change;
    };
    if (round == 0) {
      for (const JumpChange& c : changes) {
        pull(c.x, c.y, static_cast<float>(-c.change));
        pull(c.x + !c.down, c.y + c.down, static_cast<float>(c.change));
      }
    }
    FieldGrid<float> step(slope.width, slope.height);
    solver.improve(slope, step, kCycles);
    for (int y = 0; y < step.height; ++y) {
      for (int x = 0; x < step.width; ++x) {
        float& u = field.turns(x + window.x0, y + window.y0);
        u = principal(u + step(x, y));
      }
    }
  }
}

}  // namespace quadrille
