#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "patch_program.h"
#include "patch_scan.h"

namespace quadrille {

/// Points of one patch to be shaded, in samples relative to a whole sample near the patch, and
/// their premultiplied colours, 0 <= r, g, b <= alpha <= 1.
struct ColorBatch {
  static constexpr int kCapacity = 512;
  static constexpr int kPadding = 32;  ///< arrays are worked on in at most so many at a time
  static constexpr int kRuns = 256;    ///< at most

  int count = 0;
  alignas(64) float x[kCapacity + kPadding], y[kCapacity + kPadding];
  alignas(64) float s[kCapacity + kPadding],
      t[kCapacity + kPadding];  ///< parameters, from -1/2 to 1/2
  alignas(64) float color[4][kCapacity + kPadding];
  int missing_count = 0;
  int missing[kCapacity];  ///< points whose parameters were not found in or next to the patch
};

/// A run of a batch's points and where its colours go.
struct PointRun {
  int begin, count;
  std::ptrdiff_t target;
};

/// Appends the centres of samples of spans, relative to `origin`; targets are those of planes with
/// this stride that begin with the sample `first`. Returns how many spans found room, at least one
/// if the batch was empty and no span is longer than its capacity. Writes one run for each.
int append_spans(std::span<const SampleSpan> spans, const std::array<int, 2>& origin,
                 const std::array<int, 2>& first, std::ptrdiff_t stride, ColorBatch& batch,
                 PointRun* runs);

/// The points' parameters; those of missing points are meaningless. `map` takes points to
/// normalized ones: x = map[0] x + map[1] y + map[2]. Colours err by at most 1/250 of an 8-bit step
/// by this. What a point gets does not depend on the others, and all instruction sets give the same
/// bits.
void invert_points(const PatchProgram& program, const float (&map)[6], ColorBatch& batch);

/// Colours at the parameters. With `opaque` alpha is left alone. All instruction sets give the same
/// bits.
void shade_parameters(const PatchProgram& program, bool opaque, ColorBatch& batch);

/// Copies runs of channels to planes of samples.
void scatter_runs(const ColorBatch& batch, const PointRun* runs, int run_count, int channels,
                  float* const (&planes)[4]);
/// The same into opaque 8-bit pixels.
void scatter_words(const ColorBatch& batch, const PointRun* runs, int run_count,
                   std::uint32_t* pixels);

}  // namespace quadrille
