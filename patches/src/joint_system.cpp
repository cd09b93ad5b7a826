#include "joint_system.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "parallel_ranges.h"
#include "picture_sampling.h"
#include "shape_energy.h"

namespace quadrille {
namespace {

// A round's step is an approximation anyway: at 0.1 it costs a fifth more and gains 0.01 dB.
constexpr double kTolerance = 0.15;
constexpr int kMaxIterations = 60;
/// Keeps vertices in flat parts of a picture defined; squared gradients of one 8-bit step in 100
/// pixels.
constexpr float kStiffnessFloor = 1e-9f;

/// Whether corner k lies at parameter 1.
constexpr int kAtU[4] = {0, 1, 1, 0}, kAtV[4] = {0, 0, 1, 1};

/// The samples of one pixel for the batch: the residual, and the gradient of `mean` as the
/// difference of two neighbours over their distance; at the picture's sides the pixel itself stands
/// for the neighbour that is missing.
void add_pixel(const Raster& picture, const std::vector<Color>& mean, std::size_t pixel, int x,
               int y, int i, MotionBatch& batch) {
  const int row = picture.width;
  const Color* const here = mean.data() + pixel;
  const bool left = x > 0, right = x + 1 < row, above = y > 0, below = y + 1 < picture.height;
  const float across = left && right ? 0.5f : 1.0f, down = above && below ? 0.5f : 1.0f;
  batch.gradient[0][i] = (here[right ? 1 : 0] - here[left ? -1 : 0]) * across;
  batch.gradient[1][i] = (here[below ? row : 0] - here[above ? -row : 0]) * down;
  batch.residual[i] = 2 * (premultiplied_pixel(picture, pixel) - *here);
}

/// Adds the samples of the block's patch number `local` to the sums: those at mixed pixels, or the
/// others. Returns false when there were no more than these.
bool add_samples(const SampleBlock& samples, int local, const Raster& picture,
                 const std::vector<Color>& mean, const MixedPixels& mixed, bool at_mixed,
                 MotionSums& sums) {
  MotionBatch batch;
  const auto flush = [&] {
    const int padded = padded_count(batch.count);
    for (int i = batch.count; i < padded; ++i) {
      batch.u[i] = batch.v[i] = 0;
      batch.residual[i] = batch.gradient[0][i] = batch.gradient[1][i] = Color::Zero();
    }
    batch.count = padded;
    add_batch(picture.channels, batch, sums);
    batch.count = 0;
  };
  const auto width = static_cast<std::uint32_t>(picture.width);
  std::uint32_t expected = ~std::uint32_t{0};
  int x = 0, y = 0;
  bool left_out = false;
  for (std::size_t sample = samples.begin[local]; sample < samples.begin[local + 1]; ++sample) {
    const std::uint32_t pixel = samples.pixel[sample];
    if (mixed.contains(pixel) != at_mixed) {
      left_out = true;
      continue;
    }
    ++x;
    if (pixel != expected || x == picture.width) {
      x = static_cast<int>(pixel % width);
      y = static_cast<int>(pixel / width);
    }
    expected = pixel + 1;
    batch.u[batch.count] = samples.u[sample];
    batch.v[batch.count] = samples.v[sample];
    add_pixel(picture, mean, pixel, x, y, batch.count, batch);
    if (++batch.count == FitBatch::kSize) flush();
  }
  if (batch.count > 0) flush();
  return left_out;
}

double dot(const WedgeUnknowns& a, const WedgeUnknowns& b) {
  return static_cast<double>(a.cwiseProduct(b).sum());
}

/// What the conjugate gradients carry from one iteration to the next.
struct GradientState {
  JointVector solution, residual, direction;
  JointVector product;  ///< of the matrix and the direction, or the preconditioned residual

  double advance(float alpha, const ColorSystem& system,
                 const std::vector<Eigen::Matrix2f>& inverse);
  void turn(float keep);
};

/// Takes a step of length `alpha` along the direction and leaves the preconditioned residual in
/// the product; returns the product of both residuals. `inverse` preconditions the moves.
double GradientState::advance(float alpha, const ColorSystem& system,
                              const std::vector<Eigen::Matrix2f>& inverse) {
  const double of_colors = sum_over_ranges(system.wedge_count(), 0.0, [&](int begin, int end) {
    double sum = 0;
    for (int w = begin; w < end; ++w) {
      if (alpha != 0) {
        solution.colors[w] += alpha * direction.colors[w];
        residual.colors[w] -= alpha * product.colors[w];
      }
      product.colors[w] = residual.colors[w] * system.inverse_block(w);
      sum += dot(residual.colors[w], product.colors[w]);
    }
    return sum;
  });
  const int vertices = static_cast<int>(inverse.size());
  const double of_moves = sum_over_ranges(vertices, 0.0, [&](int begin, int end) {
    double sum = 0;
    for (int v = begin; v < end; ++v) {
      if (alpha != 0) {
        solution.moves[v] += alpha * direction.moves[v];
        residual.moves[v] -= alpha * product.moves[v];
      }
      product.moves[v] = inverse[v] * residual.moves[v];
      sum += static_cast<double>(residual.moves[v].dot(product.moves[v]));
    }
    return sum;
  });
  return of_colors + of_moves;
}

/// The next direction: the preconditioned residual and `keep` times the last one.
void GradientState::turn(float keep) {
  for_each_range(static_cast<int>(direction.colors.size()), [&](int begin, int end) {
    for (int w = begin; w < end; ++w) {
      direction.colors[w] = product.colors[w] + keep * direction.colors[w];
    }
  });
  for_each_range(static_cast<int>(direction.moves.size()), [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      direction.moves[v] = product.moves[v] + keep * direction.moves[v];
    }
  });
}

}  // namespace

JointSystem::JointSystem(ColorSystem& colors, const PatchMesh& patches,
                         const std::vector<SampleBlock>& samples, const Raster& picture,
                         const std::vector<Color>& mean, const VertexGuides& guides,
                         double shape_weight)
    : colors_(colors),
      patches_(patches),
      guides_(guides),
      groups_(colors.groups().size()),
      force_(patches.mesh.vertex_count()),
      stiffness_(patches.mesh.vertex_count()),
      color_parts_(colors.groups().size() * kLaneCount),
      move_parts_(colors.groups().size() * kLaneCount) {
  static_assert(kSampleBlock % kLaneCount == 0);
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t b) {
    assemble_block(samples[b], picture, mean, shape_weight);
  });
  gather_vertices();
}

void JointSystem::assemble_block(const SampleBlock& samples, const Raster& picture,
                                 const std::vector<Color>& mean, double shape_weight) {
  for (int local = 0; local < samples.patch_count(); ++local) {
    const int q = samples.first_patch + local, lane = q % kLaneCount;
    MotionSums sums{}, torn{};
    const bool has_mixed =
        add_samples(samples, local, picture, mean, colors_.mixed_pixels(), false, sums);
    // The colours of torn pixels depend on several patches. They pull at the vertices, but without
    // regard to how colours change at the same time, which keeps the system positive definite.
    if (has_mixed) {
      add_samples(samples, local, picture, mean, colors_.mixed_pixels(), true, torn);
    }
    MotionGroup& group = groups_[q / kLaneCount];
    for (int c = 0; c < picture.channels; ++c) {
      for (int d = 0; d < 2; ++d) {
        for (int i = 0; i < 25; ++i) {
          group.mixed[c][d][i][lane] = static_cast<float>(sums.mixed[c][d][i]);
        }
      }
    }
    const ShapeDerivatives shape = shape_derivatives(patches_.mesh, q);
    for (int k = 0; k < 4; ++k) {
      group.vertices[k][lane] = patches_.mesh.quads()[q][k];
      for (int d = 0; d < 2; ++d) {
        const int row = 2 * k + d;
        move_parts_[q][k][d] = static_cast<float>(-sums.force[k][d] - torn.force[k][d] -
                                                  shape_weight * shape.gradient[row]);
        for (int l = 0; l < 4; ++l) {
          for (int e = 0; e < 2; ++e) {
            const int product = 3 * (kAtV[k] + kAtV[l]) + kAtU[k] + kAtU[l];
            const double data = sums.stiffness[d + e][product] + torn.stiffness[d + e][product];
            group.stiffness[8 * row + 2 * l + e][lane] =
                static_cast<float>(data + shape_weight * shape.matrix(row, 2 * l + e));
          }
        }
      }
    }
  }
}

void JointSystem::gather_vertices() {
  const QuadMesh& mesh = patches_.mesh;
  for_each_range(mesh.vertex_count(), [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      force_[v].setZero();
      stiffness_[v] = kStiffnessFloor * Eigen::Matrix2f::Identity();
      for (const int h : mesh.fan(v)) {
        const int q = QuadMesh::quad_of(h), k = QuadMesh::corner_of(h);
        force_[v] += move_parts_[q][k];
        for (int d = 0; d < 2; ++d) {
          for (int e = 0; e < 2; ++e) {
            stiffness_[v](d, e) +=
                groups_[q / kLaneCount].stiffness[8 * (2 * k + d) + 2 * k + e][q % kLaneCount];
          }
        }
      }
    }
  });
}

Eigen::Matrix2f JointSystem::inverse_stiffness(int v, float damping) const {
  Eigen::Matrix2f damped = stiffness_[v];
  damped.diagonal() *= 1 + damping;
  switch (guides_.kind(v)) {
    case VertexGuides::Kind::free:
      return damped.inverse();
    case VertexGuides::Kind::fixed:
      return Eigen::Matrix2f::Zero();
    default: {
      const Eigen::Vector2f along = guides_.direction(v).cast<float>();
      return along * along.transpose() / along.dot(damped * along);
    }
  }
}

double JointSystem::multiply(const JointVector& x, float damping, JointVector& product) {
  const auto& elements = colors_.groups();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, groups_.size(), 32), [&](const auto& range) {
    for (std::size_t g = range.begin(); g < range.end(); ++g) {
      quadrille::multiply(elements[g], groups_[g], colors_.channels(), x.colors.data(),
                          x.moves.data(), &color_parts_[g * kLaneCount],
                          &move_parts_[g * kLaneCount]);
    }
  });
  const double of_colors = colors_.gather(x.colors, color_parts_, product.colors).sum();
  const QuadMesh& mesh = patches_.mesh;
  return of_colors + sum_over_ranges(mesh.vertex_count(), 0.0, [&](int begin, int end) {
           double sum = 0;
           for (int v = begin; v < end; ++v) {
             product.moves[v] = damping * stiffness_[v].diagonal().cwiseProduct(x.moves[v]);
             for (const int h : mesh.fan(v)) product.moves[v] += move_parts_[h >> 2][h & 3];
             sum += static_cast<double>(x.moves[v].dot(product.moves[v]));
           }
           return sum;
         });
}

int JointSystem::solve(double given_damping, JointVector& step) {
  const auto damping = static_cast<float>(given_damping);
  const int wedges = colors_.wedge_count(), vertices = patches_.mesh.vertex_count();
  std::vector<Eigen::Matrix2f> inverse(vertices);
  for_each_range(vertices, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) inverse[v] = inverse_stiffness(v, damping);
  });
  const JointVector zero = {ColorSystem::Vector(wedges, WedgeUnknowns::Zero()),
                            std::vector<Eigen::Vector2f>(vertices, Eigen::Vector2f::Zero())};
  GradientState state = {zero, {colors_.right_hand_side, force_}, zero, zero};
  double rho = state.advance(0, colors_, inverse);
  const double enough = rho * kTolerance * kTolerance;
  state.direction = state.product;
  int iterations = 0;
  while (rho > enough && iterations < kMaxIterations) {
    const double curvature = multiply(state.direction, damping, state.product);
    if (!(curvature > 0)) break;
    const double next = state.advance(static_cast<float>(rho / curvature), colors_, inverse);
    state.turn(static_cast<float>(next / rho));
    rho = next;
    ++iterations;
  }
  step = std::move(state.solution);
  return iterations;
}

}  // namespace quadrille
