#pragma once

#include <cstdint>
#include <random>

#include "quadrille/patch_mesh.h"
#include "quadrille/vector_image.h"

namespace quadrille::testing {

/// Reproducible on every platform, unlike the standard distributions.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  /// In [low, high).
  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * (engine_() * 0x1p-32);
  }
  /// In [low, high].
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint32_t>(high - low + 1));
  }

 private:
  std::mt19937 engine_;
};

/// A regular lattice of columns x rows unit-less quads over [0, width] x [0, height].
QuadMesh lattice(int columns, int rows, double width, double height);

struct RandomPatchOptions {
  double jitter = 0.25;    ///< largest move of an interior vertex, in spacings
  double curvature = 0.6;  ///< largest deviation of a tangent from its chord, in chord lengths
};

/// A lattice with vertices moved at random (those of the border along it), quads that start at
/// random corners, and randomly curved inner edges; tangents of folded patches are drawn back to
/// their chords until no patch folds. Border edges stay straight lines. Colours are black.
PatchMesh random_patches(int columns, int rows, double width, double height, std::uint32_t seed,
                         const RandomPatchOptions& options = {});

/// Random colours, gradients and twists that may leave [0, 1] here and there; alpha is random too
/// unless `opaque`.
void set_random_colors(PatchMesh& patches, std::uint32_t seed, bool opaque = true);

/// Every patch reproduces base + along_x x + along_y y.
void set_linear_colors(PatchMesh& patches, const Color& base, const Color& along_x = Color::Zero(),
                       const Color& along_y = Color::Zero());

using quadrille::single_layer;

}  // namespace quadrille::testing
