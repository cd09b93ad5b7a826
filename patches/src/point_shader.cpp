#include "point_shader.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "point_shader.cpp"
#include <hwy/foreach_target.h>

#include "newton-inl.h"
#include "pixel_words-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrille {
namespace HWY_NAMESPACE {
namespace {

/// Vectors that are inverted side by side.
constexpr int kTogether = 2;

int append(std::span<const SampleSpan> spans, const std::array<int, 2>& origin,
           const std::array<int, 2>& first, std::ptrdiff_t stride, ColorBatch& batch,
           PointRun* runs) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const V centers = hn::Iota(d, 0) + number(0.5f);
  const int most = std::min(static_cast<int>(spans.size()), ColorBatch::kRuns);
  int taken = 0, at = batch.count;
  for (; taken < most; ++taken) {
    const SampleSpan& s = spans[taken];
    const int count = s.x_end - s.x_begin;
    if (at + count > ColorBatch::kCapacity) break;
    const V y = number(static_cast<float>(s.y - origin[1]) + 0.5f);
    // In whole vectors: what is too much is written over.
    for (int i = 0; i < count; i += lanes) {
      hn::StoreU(centers + number(static_cast<float>(s.x_begin - origin[0] + i)), d,
                 batch.x + at + i);
      hn::StoreU(y, d, batch.y + at + i);
    }
    runs[taken] = {at, count, (s.y - first[1]) * stride + (s.x_begin - first[0])};
    at += count;
  }
  batch.count = at;
  return taken;
}

void invert_all(const PatchProgram& p, const float (&map)[6], ColorBatch& batch) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int first = 0; first < batch.count; first += kTogether * lanes) {
    V x[kTogether], y[kTogether];
    for (int k = 0; k < kTogether; ++k) {
      const V given_x = hn::Load(d, batch.x + first + k * lanes);
      const V given_y = hn::Load(d, batch.y + first + k * lanes);
      x[k] = (number(map[0]) * given_x + number(map[1]) * given_y) + number(map[2]);
      y[k] = (number(map[3]) * given_x + number(map[4]) * given_y) + number(map[5]);
    }
    Parameters at[kTogether];
    invert<kTogether>(p, x, y, kMargin, 1, at);
    for (int k = 0; k < kTogether; ++k) {
      const int i = first + k * lanes;
      hn::Store(at[k].s, d, batch.s + i);
      hn::Store(at[k].t, d, batch.t + i);
      if (HWY_UNLIKELY(!hn::AllTrue(d, at[k].found))) {
        alignas(64) float found[16];
        hn::Store(hn::IfThenElseZero(at[k].found, number(1)), d, found);
        for (int j = 0; j < std::min(lanes, batch.count - i); ++j) {
          if (found[j] == 0) batch.missing[batch.missing_count++] = i + j;
        }
      }
    }
  }
}

template <bool opaque>
HWY_INLINE void shade_all(const PatchProgram& p, ColorBatch& batch) {
  const Floats d;
  const V zero = hn::Zero(d), one = number(1);
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int i = 0; i < batch.count; i += lanes) {
    const V s = hn::Load(d, batch.s + i), t = hn::Load(d, batch.t + i);
    V alpha = one;
    if constexpr (!opaque) {
      alpha = hn::Min(hn::Max(bicubic(p.color[3], s, t), zero), one);
      hn::Store(alpha, d, batch.color[3] + i);
    }
    for (int k = 0; k < 3; ++k) {
      const V color = bicubic(p.color[k], s, t);
      hn::Store(hn::Min(hn::Max(color, zero), alpha), d, batch.color[k] + i);
    }
  }
}

void shade(const PatchProgram& program, bool opaque, ColorBatch& batch) {
  if (opaque) {
    shade_all<true>(program, batch);
  } else {
    shade_all<false>(program, batch);
  }
}

void scatter(const ColorBatch& batch, const PointRun* runs, int run_count, int channels,
             float* const (&planes)[4]) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int r = 0; r < run_count; ++r) {
    const PointRun run = runs[r];
    for (int i = 0; i < run.count; i += lanes) {
      const Mask inside = hn::FirstN(d, static_cast<std::size_t>(run.count - i));
      for (int k = 0; k < channels; ++k) {
        hn::BlendedStore(hn::LoadU(d, batch.color[k] + run.begin + i), inside, d,
                         planes[k] + run.target + i);
      }
    }
  }
}

void scatter_as_words(const ColorBatch& batch, const PointRun* runs, int run_count,
                      std::uint32_t* pixels) {
  const Floats d;
  const hn::RebindToUnsigned<Floats> du;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int r = 0; r < run_count; ++r) {
    const PointRun run = runs[r];
    for (int i = 0; i < run.count; i += lanes) {
      const auto inside = hn::FirstN(du, static_cast<std::size_t>(run.count - i));
      const int at = run.begin + i;
      const auto words =
          opaque_words(d, hn::LoadU(d, batch.color[0] + at), hn::LoadU(d, batch.color[1] + at),
                       hn::LoadU(d, batch.color[2] + at));
      hn::BlendedStore(words, inside, du, pixels + run.target + i);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quadrille
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrille {
namespace {
HWY_EXPORT(append);
HWY_EXPORT(invert_all);
HWY_EXPORT(shade);
HWY_EXPORT(scatter);
HWY_EXPORT(scatter_as_words);
}  // namespace

int append_spans(std::span<const SampleSpan> spans, const std::array<int, 2>& origin,
                 const std::array<int, 2>& first, std::ptrdiff_t stride, ColorBatch& batch,
                 PointRun* runs) {
  return HWY_DYNAMIC_DISPATCH(append)(spans, origin, first, stride, batch, runs);
}

void invert_points(const PatchProgram& program, const float (&map)[6], ColorBatch& batch) {
  batch.missing_count = 0;
  if (batch.count == 0) return;
  const int padded = batch.count + ColorBatch::kPadding;
  std::fill(batch.x + batch.count, batch.x + padded, batch.x[batch.count - 1]);
  std::fill(batch.y + batch.count, batch.y + padded, batch.y[batch.count - 1]);
  HWY_DYNAMIC_DISPATCH(invert_all)(program, map, batch);
}

void shade_parameters(const PatchProgram& program, bool opaque, ColorBatch& batch) {
  HWY_DYNAMIC_DISPATCH(shade)(program, opaque, batch);
}

void scatter_runs(const ColorBatch& batch, const PointRun* runs, int run_count, int channels,
                  float* const (&planes)[4]) {
  HWY_DYNAMIC_DISPATCH(scatter)(batch, runs, run_count, channels, planes);
}

void scatter_words(const ColorBatch& batch, const PointRun* runs, int run_count,
                   std::uint32_t* pixels) {
  HWY_DYNAMIC_DISPATCH(scatter_as_words)(batch, runs, run_count, pixels);
}

}  // namespace quadrille
#endif
