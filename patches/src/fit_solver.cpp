#include "fit_solver.h"

#include <cmath>

#include "parallel_ranges.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using Vector = NormalEquations::Vector;

Eigen::Array4d dot(const WedgeUnknowns& a, const WedgeUnknowns& b) {
  return a.cwiseProduct(b).rowwise().sum().array().cast<double>();
}

/// Channel by channel; a channel that is already solved stays where it is.
Eigen::Array4d ratio(const Eigen::Array4d& a, const Eigen::Array4d& b) {
  return (b > 0).select(a / b, 0.0);
}

}  // namespace

NormalEquations::Vector solve(NormalEquations& system, const FitOptions& options,
                              const RunContext& context, FitReport& report) {
  const int n = system.wedge_count();
  const WedgeUnknowns zero = WedgeUnknowns::Zero();
  Vector solution(n, zero), direction(n), product(n);
  Vector& residual = system.right_hand_side;
  const auto sum = [&](const auto& body) {
    return sum_over_ranges(n, Eigen::Array4d(0, 0, 0, 0), body);
  };

  Eigen::Array4d rho = sum([&](int begin, int end) {
    Eigen::Array4d part = Eigen::Array4d::Zero();
    for (int w = begin; w < end; ++w) {
      direction[w] = residual[w] * system.inverse_block(w);
      part += dot(residual[w], direction[w]);
    }
    return part;
  });
  const double initial = rho.sum();
  if (!std::isfinite(initial)) {
    throw Error(ErrorCode::numerical_failure,
                "the equations of the colours are not finite; pass a mesh whose quads have areas");
  }
  report = {0, initial > 0 ? 1.0 : 0.0};
  while (report.residual > options.tolerance && report.iterations < options.max_iterations) {
    const Eigen::Array4d alpha = ratio(rho, system.multiply(direction, product));
    const Eigen::Vector4f step = alpha.matrix().cast<float>();
    Vector& preconditioned = product;
    const Eigen::Array4d next = sum([&](int begin, int end) {
      Eigen::Array4d part = Eigen::Array4d::Zero();
      for (int w = begin; w < end; ++w) {
        solution[w] += step.asDiagonal() * direction[w];
        residual[w] -= step.asDiagonal() * product[w];
        preconditioned[w] = residual[w] * system.inverse_block(w);
        part += dot(residual[w], preconditioned[w]);
      }
      return part;
    });
    const Eigen::Vector4f keep = ratio(next, rho).matrix().cast<float>();
    rho = next;
    ++report.iterations;
    report.residual = std::sqrt(std::max(0.0, rho.sum()) / initial);
    for_each_range(n, [&](int begin, int end) {
      for (int w = begin; w < end; ++w) {
        direction[w] = preconditioned[w] + keep.asDiagonal() * direction[w];
      }
    });
    // Progress on the logarithmic scale of the residual.
    const double done = std::log(report.residual + 1e-300) / std::log(options.tolerance);
    context.progress("fit", 0.5 + 0.5 * std::min(1.0, std::max(0.0, done)));
  }
  return solution;
}

}  // namespace quadrille
