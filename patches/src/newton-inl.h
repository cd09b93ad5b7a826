// Newton's inversion of a patch's geometry for vectors of points; compiled once per instruction
// set.
#include "patch_program.h"

#if defined(QUADRILLE_NEWTON_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRILLE_NEWTON_INL_H
#undef QUADRILLE_NEWTON_INL_H
#else
#define QUADRILLE_NEWTON_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quadrille {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, 16>;
using V = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

/// Samples' parameters may end this far outside the square; the outline is scanned as a polyline.
constexpr float kMargin = 0.02f;

HWY_INLINE V number(float x) { return hn::Set(Floats(), x); }

struct Parameters {
  V s, t;
  Mask found;
};

/// One step of Newton's method from (s, t) toward the normalized point (x, y). `sound` where the
/// geometry does not fold there, `arrived` where by the program's bounds the end is the root to
/// 1 / `strictness` of what they allow.
struct NewtonStep {
  V s, t;
  Mask sound, arrived;
};
HWY_INLINE NewtonStep newton_step(const PatchProgram& p, const V& x, const V& y, const V& s,
                                  const V& t, float strictness) {
  V value[2], along_s[2], along_t[2];
  for (int d = 0; d < 2; ++d) {
    const float* const q = p.position[d];
    const V a = number(q[1]) * s + number(q[0]), as = a * s;
    const V b = number(q[4]) * s + number(q[3]), b1 = b * s + number(q[2]);
    const V e = number(q[8]) * s + number(q[7]);
    const V c = e * t + (number(q[6]) * s + number(q[5]));
    V b0 = b1 * s;
    if (d == 1) b0 = b0 + number(1);
    const V slope = c * t + b0;
    V higher_s = (number(q[8]) * t + number(q[6])) * t + ((number(q[4]) * s + b) * s + b1);
    along_s[d] = higher_s * t + ((number(q[1]) * s + a) * s + as);
    V constant = as * s;
    if (d == 0) {
      constant = constant + s;
      along_s[d] = along_s[d] + number(1);
    }
    value[d] = slope * t + constant;
    along_t[d] = (e * t + c) * t + slope;
  }
  const V miss_x = x - value[0], miss_y = y - value[1];
  const V determinant = along_s[0] * along_t[1] - along_t[0] * along_s[1];
  const V inverse = number(1) / determinant;
  const V step_s = (miss_x * along_t[1] - miss_y * along_t[0]) * inverse;
  const V step_t = (along_s[0] * miss_y - along_s[1] * miss_x) * inverse;
  // Squares of the step's length and of the Jacobian's inverse's Frobenius norm.
  const V length = step_s * step_s + step_t * step_t;
  const V frobenius = (along_s[0] * along_s[0] + along_s[1] * along_s[1]) +
                      (along_t[0] * along_t[0] + along_t[1] * along_t[1]);
  const V norm = frobenius * (inverse * inverse);
  const V bound = hn::Max(number(p.newton_bound * p.newton_bound),
                          length * number(p.color_bound * p.color_bound * strictness * strictness));
  return {s + step_s, t + step_t, determinant > hn::Zero(Floats()),
          norm * (length * bound) <= number(1)};
}

/// Parameters of vectors of normalized points; found where they lie at most `margin` outside the
/// square. All take two steps, which mostly do, so that the vectors' arithmetic overlaps; then
/// lanes that have not arrived go on while the others stay, so that no point's result depends on
/// its neighbours.
template <int count>
HWY_INLINE void invert(const PatchProgram& p, const V (&x)[count], const V (&y)[count],
                       float margin, float strictness, Parameters (&found)[count]) {
  constexpr int kMostSteps = 6;
  const V half = number(0.5f), far = number(1 + margin), reach = number(0.5f + margin);
  const auto near = [](const NewtonStep& at, const V& limit) {
    return hn::And(hn::Abs(at.s) < limit, hn::Abs(at.t) < limit);
  };
  NewtonStep at[count];
  // A lane that meets a fold or leaves the neighbourhood of the square has failed.
  Mask sound[count];
  for (int k = 0; k < count; ++k) {
    const auto start = [&](int d) {
      const float* const w = p.start[d];
      const V value = (number(w[3]) * x[k] + (number(w[4]) * y[k] + number(w[1]))) * x[k] +
                      ((number(w[5]) * y[k] + number(w[2])) * y[k] + number(w[0]));
      return hn::Min(hn::Max(value, hn::Neg(reach)), reach);
    };
    at[k] = newton_step(p, x[k], y[k], start(0), start(1), strictness);
  }
  for (int k = 0; k < count; ++k) {
    sound[k] = hn::And(at[k].sound, near(at[k], far));
    at[k] = newton_step(p, x[k], y[k], at[k].s, at[k].t, strictness);
    sound[k] = hn::And(sound[k], hn::And(at[k].sound, near(at[k], far)));
  }
  for (int k = 0; k < count; ++k) {
    Mask arrived = hn::And(at[k].arrived, sound[k]);
    Mask active = hn::AndNot(at[k].arrived, sound[k]);
    for (int step = 2; HWY_UNLIKELY(step < kMostSteps && !hn::AllFalse(Floats(), active)); ++step) {
      const NewtonStep next = newton_step(p, x[k], y[k], at[k].s, at[k].t, strictness);
      at[k].s = hn::IfThenElse(active, next.s, at[k].s);
      at[k].t = hn::IfThenElse(active, next.t, at[k].t);
      active = hn::And(active, hn::And(next.sound, near(next, far)));
      arrived = hn::Or(arrived, hn::And(active, next.arrived));
      active = hn::AndNot(next.arrived, active);
    }
    found[k] = {at[k].s, at[k].t, hn::And(arrived, near(at[k], half + number(margin)))};
  }
}

HWY_INLINE V bicubic(const float* c, const V& s, const V& t) {
  const auto row = [&](int j) {
    const float* const w = c + 4 * j;
    return ((number(w[3]) * s + number(w[2])) * s + number(w[1])) * s + number(w[0]);
  };
  return ((row(3) * t + row(2)) * t + row(1)) * t + row(0);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quadrille
HWY_AFTER_NAMESPACE();

#endif
