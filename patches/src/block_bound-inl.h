// How well interpolation at 4 x 4 Chebyshev nodes gives a patch's colours in blocks of samples, by
// interval arithmetic; compiled once per instruction set.
#include "newton-inl.h"

#if defined(QUADRILLE_BLOCK_BOUND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRILLE_BLOCK_BOUND_INL_H
#undef QUADRILLE_BLOCK_BOUND_INL_H
#else
#define QUADRILLE_BLOCK_BOUND_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace quadrille {
namespace HWY_NAMESPACE {
namespace {

/// The numbers at most `r` away from `m`. Rounding errors of the arithmetic are left out.
struct Interval {
  V m, r;
};
HWY_INLINE Interval operator+(const Interval& a, const Interval& b) {
  return {a.m + b.m, a.r + b.r};
}
HWY_INLINE Interval operator*(const Interval& a, const Interval& b) {
  return {a.m * b.m, hn::Abs(a.m) * b.r + a.r * (hn::Abs(b.m) + b.r)};
}
HWY_INLINE Interval operator*(float a, const Interval& b) {
  return {number(a) * b.m, number(a) * b.r};  // a > 0
}
HWY_INLINE Interval exactly(const V& m) { return {m, hn::Zero(Floats())}; }
HWY_INLINE V magnitude(const Interval& a) { return hn::Abs(a.m) + a.r; }

/// Derivatives of one function of (s, t) in a box: [i][j] i times along s, j times along t.
struct Partials {
  Interval d[4][4];
};

/// Coefficients of a cubic around x instead of 0.
HWY_INLINE void shift(V& c0, V& c1, V& c2, const V& c3, const V& x) {
  const V a = c3 * x, b = c2 + a;
  const V twice = b + c2;
  c0 = ((b * x) + c1) * x + c0;
  c1 = (twice + a + a) * x + c1;
  c2 = b + a + a;
}
/// The same of a bicubic polynomial; [i][j] weighs s^i t^j.
HWY_INLINE void shift(V (&c)[4][4], const V& s, const V& t) {
  for (int j = 0; j < 4; ++j) shift(c[0][j], c[1][j], c[2][j], c[3][j], s);
  for (int i = 0; i < 4; ++i) shift(c[i][0], c[i][1], c[i][2], c[i][3], t);
}

/// Derivatives of a bicubic polynomial for |s| <= box[0], |t| <= box[1]: those in the middle, and
/// the sum of the sizes of all terms that are added on the way.
HWY_INLINE void bound_partials(const V (&c)[4][4], const V (&box)[2], Partials& found) {
  constexpr float kFactorial[4] = {1, 1, 2, 6};
  V size[4][4], most[4][4];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) size[i][j] = most[i][j] = hn::Abs(c[i][j]);
  }
  shift(most, box[0], box[1]);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const V factor = number(kFactorial[i] * kFactorial[j]);
      found.d[i][j] = {factor * c[i][j], factor * (most[i][j] - size[i][j])};
    }
  }
}

/// The geometry around a point, its linear part made the identity there, in a box.
struct LocalGeometry {
  V inverse[2][2];  ///< of the Jacobian in the middle
  V c[2][4][4];
  Partials partials[2];
  V spread[2][2];  ///< the Jacobian's inverse in the box is at most this far from the identity
  Mask regular;
};

HWY_INLINE void find_geometry(const PatchProgram& p, const V& s, const V& t, LocalGeometry& g) {
  const V zero = hn::Zero(Floats());
  V c[2][4][4];
  for (int d = 0; d < 2; ++d) {
    const float* const q = p.position[d];
    for (auto& row : c[d]) {
      for (V& v : row) v = zero;
    }
    c[d][1][0] = number(d == 0), c[d][0][1] = number(d == 1);
    c[d][2][0] = number(q[0]), c[d][3][0] = number(q[1]);
    c[d][1][1] = number(q[2]), c[d][2][1] = number(q[3]), c[d][3][1] = number(q[4]);
    c[d][0][2] = number(q[5]), c[d][1][2] = number(q[6]);
    c[d][0][3] = number(q[7]), c[d][1][3] = number(q[8]);
    shift(c[d], s, t);
  }
  const V determinant = c[0][1][0] * c[1][0][1] - c[0][0][1] * c[1][1][0];
  const V reciprocal = number(1) / determinant;
  g.regular = determinant > zero;
  g.inverse[0][0] = c[1][0][1] * reciprocal;
  g.inverse[0][1] = hn::Neg(c[0][0][1]) * reciprocal;
  g.inverse[1][0] = hn::Neg(c[1][1][0]) * reciprocal;
  g.inverse[1][1] = c[0][1][0] * reciprocal;
  for (int d = 0; d < 2; ++d) {
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        g.c[d][i][j] = i + j < 2 ? number(d == 0 ? i : j)
                                 : g.inverse[d][0] * c[0][i][j] + g.inverse[d][1] * c[1][i][j];
      }
    }
    g.c[d][0][0] = zero;
  }
}

/// Bounds everything in a box. The Jacobian there is I + E with |E| <= e, so its inverse is at most
/// (I - e)^-1 - I from I.
HWY_INLINE void bound_geometry(const V (&box)[2], LocalGeometry& g) {
  V e[2][2];
  for (int d = 0; d < 2; ++d) {
    bound_partials(g.c[d], box, g.partials[d]);
    e[d][0] = g.partials[d].d[1][0].r;
    e[d][1] = g.partials[d].d[0][1].r;
  }
  const V one = number(1), cross = e[0][1] * e[1][0];
  const V determinant = (one - e[0][0]) * (one - e[1][1]) - cross;
  const V reciprocal = one / determinant;
  g.regular =
      hn::And(g.regular, hn::And(hn::Max(e[0][0], e[1][1]) < one, determinant > number(0.05f)));
  g.spread[0][0] = (one - e[1][1]) * reciprocal - one;
  g.spread[1][1] = (one - e[0][0]) * reciprocal - one;
  g.spread[0][1] = e[0][1] * reciprocal;
  g.spread[1][0] = e[1][0] * reciprocal;
}

/// A pair of parameters or their derivatives.
struct Pair {
  Interval s, t;
};
/// The Jacobian's inverse times a vector.
HWY_INLINE Pair solve(const LocalGeometry& g, const Pair& b) {
  const V x = magnitude(b.s), y = magnitude(b.t);
  return {{b.s.m, b.s.r + (g.spread[0][0] * x + g.spread[0][1] * y)},
          {b.t.m, b.t.r + (g.spread[1][0] * x + g.spread[1][1] * y)}};
}

/// What the derivatives of order 2, 3 and 4 of a function of (s, t) are multiplied with in a
/// derivative along a curve: chain rule.
struct Chain {
  Interval second[3], third[4], fourth[3];
};
HWY_INLINE Interval second_part(const Partials& f, const Chain& x) {
  return f.d[2][0] * x.second[0] + f.d[1][1] * x.second[1] + f.d[0][2] * x.second[2];
}
HWY_INLINE Interval third_part(const Partials& f, const Chain& x) {
  return (f.d[3][0] * x.third[0] + f.d[2][1] * x.third[1]) +
         (f.d[1][2] * x.third[2] + f.d[0][3] * x.third[3]);
}
/// There are no fourth derivatives along s or t alone.
HWY_INLINE Interval fourth_part(const Partials& f, const Chain& x) {
  return f.d[3][1] * x.fourth[0] + f.d[2][2] * x.fourth[1] + f.d[1][3] * x.fourth[2];
}

/// The fourth derivative of the parameters along a straight line of points, and the chain of that
/// order. `first` are the parameters' first derivatives.
struct FourthOrder {
  Pair parameters;
  Chain chain;
};
HWY_INLINE FourthOrder fourth_order(const LocalGeometry& g, const Pair& first) {
  const auto solve_for = [&](const auto& part) {
    const Interval x = part(g.partials[0]), y = part(g.partials[1]);
    return solve(g, {{hn::Neg(x.m), x.r}, {hn::Neg(y.m), y.r}});
  };
  const Interval &s = first.s, &t = first.t;
  const Interval ss = s * s, st = s * t, tt = t * t;
  Chain c;
  c.second[0] = ss, c.second[1] = 2 * st, c.second[2] = tt;
  const Pair second = solve_for([&](const Partials& f) { return second_part(f, c); });
  const Interval &s2 = second.s, &t2 = second.t;
  c.second[0] = 3 * (s * s2), c.second[1] = 3 * (s * t2 + s2 * t), c.second[2] = 3 * (t * t2);
  c.third[0] = ss * s, c.third[1] = 3 * (ss * t), c.third[2] = 3 * (s * tt), c.third[3] = tt * t;
  const Pair third =
      solve_for([&](const Partials& f) { return second_part(f, c) + third_part(f, c); });
  const Interval &s3 = third.s, &t3 = third.t;
  c.fourth[0] = 4 * (ss * st), c.fourth[1] = 6 * (ss * tt), c.fourth[2] = 4 * (st * tt);
  c.second[0] = 4 * (s * s3) + 3 * (s2 * s2);
  c.second[1] = 4 * (s * t3 + s3 * t) + 6 * (s2 * t2);
  c.second[2] = 4 * (t * t3) + 3 * (t2 * t2);
  c.third[0] = 6 * (ss * s2), c.third[1] = 6 * (ss * t2 + 2 * (st * s2));
  c.third[2] = 6 * (2 * (st * t2) + tt * s2), c.third[3] = 6 * (tt * t2);
  const Pair fourth = solve_for([&](const Partials& f) {
    return (second_part(f, c) + third_part(f, c)) + fourth_part(f, c);
  });
  return {fourth, c};
}

/// Bounds in parallelograms of points.
struct BlockBound {
  V gradient;  ///< of the colours, with respect to the parameters
  V error;     ///< of interpolation, before rounding
  Mask valid;
};

/// For the points at most `sides[0]` one way and at most `sides[1]` the other way from that with
/// the parameters (s, t): sides[k] in normalized coordinates.
///
/// Interpolation at the Chebyshev nodes of [-1, 1] errs by at most the fourth derivative over 192,
/// and once more in the other direction, where the first's error grows by Lebesgue's constant 1.85.
HWY_INLINE BlockBound bound_blocks(const PatchProgram& p, int channels, const float (&sides)[2][2],
                                   const V& s, const V& t) {
  LocalGeometry g;
  find_geometry(p, s, t, g);
  V slope[2][2], reach[2], box[2];
  for (int d = 0; d < 2; ++d) {
    for (int k = 0; k < 2; ++k) {
      slope[k][d] = g.inverse[d][0] * number(sides[k][0]) + g.inverse[d][1] * number(sides[k][1]);
    }
    reach[d] = hn::Abs(slope[0][d]) + hn::Abs(slope[1][d]);
    box[d] = number(1.5f) * reach[d];
  }
  // On the way from the middle to any point the parameters cannot leave the box, as long as in it
  // they do not change fast enough; then they stay within what that gives.
  bound_geometry(box, g);
  V within[2];
  Mask valid = g.regular;
  for (int d = 0; d < 2; ++d) {
    within[d] = reach[d] + (g.spread[d][0] * reach[0] + g.spread[d][1] * reach[1]);
    valid = hn::And(valid, within[d] <= box[d]);
  }
  bound_geometry(within, g);
  const FourthOrder along[2] = {
      fourth_order(g, solve(g, {exactly(slope[0][0]), exactly(slope[0][1])})),
      fourth_order(g, solve(g, {exactly(slope[1][0]), exactly(slope[1][1])}))};
  V gradient = hn::Zero(Floats()), error = gradient;
  for (int k = 0; k < channels; ++k) {
    V c[4][4];
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) c[i][j] = number(p.color[k][4 * j + i]);
    }
    shift(c, s, t);
    Partials f;
    bound_partials(c, within, f);
    V fourth[2];
    for (int n = 0; n < 2; ++n) {
      const auto& [parameters, chain] = along[n];
      fourth[n] =
          magnitude((f.d[1][0] * parameters.s + f.d[0][1] * parameters.t) +
                    ((second_part(f, chain) + third_part(f, chain)) + fourth_part(f, chain)));
    }
    error = hn::Max(error, (number(1.85f) * fourth[0] + fourth[1]) * number(1.0f / 192));
    const V across = magnitude(f.d[1][0]), down = magnitude(f.d[0][1]);
    gradient = hn::Max(gradient, across * across + down * down);
  }
  return {hn::Sqrt(gradient), error, valid};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quadrille
HWY_AFTER_NAMESPACE();

#endif
