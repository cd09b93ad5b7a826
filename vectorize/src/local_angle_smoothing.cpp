#include "quadrille/local_angle_smoothing.h"

#include <algorithm>
#include <cmath>

#include "angle_field.h"
#include "parallel.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using Eigen::Vector2f;
using VectorGrid = FieldGrid<Vector2f>;

constexpr int kCoarsestSide = 4;

Vector2f to_vector(std::complex<float> z) {
  const float angle = std::arg(z) / 4;
  return {std::cos(angle), std::sin(angle)};
}

/// `b` turned by the multiple of 90 degrees that brings it closest to `a`.
Vector2f matched(const Vector2f& a, const Vector2f& b) {
  const Vector2f turned(-b.y(), b.x());
  const float straight = a.dot(b), across = a.dot(turned);
  if (std::abs(straight) >= std::abs(across)) return straight < 0 ? Vector2f(-b) : b;
  return across < 0 ? Vector2f(-turned) : turned;
}

DataTerm coarser(const DataTerm& fine) {
  const int w = (fine.mass.width + 1) / 2, h = (fine.mass.height + 1) / 2;
  DataTerm coarse{FieldGrid<float>(w, h), ComplexGrid(w, h)};
  for (int y = 0; y < fine.mass.height; ++y) {
    for (int x = 0; x < fine.mass.width; ++x) {
      coarse.mass(x / 2, y / 2) += fine.mass(x, y);
      coarse.pull(x / 2, y / 2) += fine.pull(x, y);
    }
  }
  return coarse;
}

/// The weighted mean of the neighbours and the feature direction, taken one by one.
Vector2f local_mean(const VectorGrid& q, const VectorGrid& target, const FieldGrid<float>& mass,
                    int x, int y) {
  Vector2f mean = q(x, y);
  float weight = 0;
  const auto add = [&](const Vector2f& other, float other_weight) {
    const Vector2f sum = weight * mean + other_weight * matched(mean, other);
    const float length = sum.norm();
    if (length > 0) mean = sum / length;
    weight += other_weight;
  };
  if (x > 0) add(q(x - 1, y), 1);
  if (y > 0) add(q(x, y - 1), 1);
  if (x + 1 < q.width) add(q(x + 1, y), 1);
  if (y + 1 < q.height) add(q(x, y + 1), 1);
  add(target(x, y), mass(x, y));
  return mean;
}

void smooth(VectorGrid& q, const DataTerm& data, int sweeps, const RunContext& context) {
  VectorGrid target(q.width, q.height);
  std::ranges::transform(data.pull.data, target.data.begin(), to_vector);
  for (int half_sweep = 0; half_sweep < 2 * sweeps; ++half_sweep) {
    parallel_rows(context, q.height, q.width, [&](int y) {
      for (int x = (y + half_sweep) & 1; x < q.width; x += 2) {
        q(x, y) = local_mean(q, target, data.mass, x, y);
      }
    });
  }
}

}  // namespace

CrossField local_angle_smoothing(const FeatureTensor& features,
                                 const LocalSmoothingOptions& options, const RunContext& context) {
  if (!(options.alignment > 0) || options.sweeps < 0) {
    throw Error(ErrorCode::invalid_argument,
                "local smoothing needs a positive alignment and no negative number of sweeps");
  }
  std::vector<DataTerm> levels = {data_term(features, options.alignment)};
  while (options.hierarchical &&
         std::max(levels.back().mass.width, levels.back().mass.height) > kCoarsestSide) {
    levels.push_back(coarser(levels.back()));
  }
  VectorGrid q(levels.back().mass.width, levels.back().mass.height);
  std::ranges::transform(levels.back().pull.data, q.data.begin(), to_vector);
  for (std::size_t level = levels.size(); level-- > 0;) {
    smooth(q, levels[level], options.sweeps, context);
    if (level == 0) break;
    VectorGrid finer(levels[level - 1].mass.width, levels[level - 1].mass.height);
    for (int y = 0; y < finer.height; ++y) {
      for (int x = 0; x < finer.width; ++x) finer(x, y) = q(x / 2, y / 2);
    }
    q = std::move(finer);
  }

  CrossField field{ComplexGrid(q.width, q.height), {}};
  for (std::size_t i = 0; i < q.data.size(); ++i) {
    const std::complex<float> direction(q.data[i].x(), q.data[i].y());
    field.z.data[i] = unit(direction * direction * direction * direction);
  }
  AngleField angles = angle_field(features, options.alignment, context);
  set_turns(field.z, angles, context);
  field.phases.push_back({"local", singularities(field), energy(angles, context),
                          misalignment_degrees(field, features)});
  return field;
}

}  // namespace quadrille
