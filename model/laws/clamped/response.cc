#include <cmath>

#include "model/laws/clamped/at_nodes.h"
#include "model/laws/clamped/integrals.h"
#include "model/laws/clamped/on_each_cpu.h"

namespace hoplab::clamped {
namespace {

// What the response is made of, at the nodes of its rule.
template <int N, int W>
struct Bending {
  static constexpr int kTip = W - 4, kBase = W - 3, kX = W - 2, kY = W - 1;  // places of slopes

  Number<W> fx, fy, half, c0, s0, cb, sb, over_b;
  AtNodes<N, W> c, s, by_x, by_y, over, weight;

  Bending(const Tangents& at, const double* cosine, const double* sine, double load_x,
          double load_y) {
    const auto make = [](double value, double by_tip, double by_base) {
      Number<W> z;
      z.a = value;
      if constexpr (kTip >= 0) z.d[kTip] = by_tip;
      if constexpr (kBase >= 0) z.d[kBase] = by_base;
      return z;
    };
    fx = make(load_x, 0.0, 0.0);
    fy = make(load_y, 0.0, 0.0);
    if constexpr (W > 0) fx.d[kX] = fy.d[kY] = 1.0;
    half = make(0.5 * (at.base - at.tip), -0.5, 0.5);
    c0 = make(at.cos_tip, -at.sin_tip, 0.0);
    s0 = make(at.sin_tip, at.cos_tip, 0.0);
    cb = make(at.cos_base, 0.0, -at.sin_base);
    sb = make(at.sin_base, 0.0, at.cos_base);
    const Number<W> square = fx * (c0 - cb) + fy * (sb - s0);
    const double root = 1.0 / std::sqrt(1.0 + 2.0 * square.a);
    over_b = Follow(square, root, -root * root * root);
    Fill(cosine, sine);
  }
  // Slopes of kappa^2/2 by fx and fy, and 1/kappa; psi of a node moves with both ends of the arc.
  void Fill(const double* cosine, const double* sine) {
    AtNodes<N, W> square;
    const Lane<N> rule = LaneFrom<N>(kRule<N>.weight);
    c.a = LaneFrom<N>(cosine);
    s.a = LaneFrom<N>(sine);
    by_x.a = c0.a - c.a;
    by_y.a = s.a - s0.a;
    square.a = 1.0 + 2.0 * (fx.a * by_x.a + fy.a * by_y.a);
    if constexpr (W > 0) {
      const Lane<N> node = LaneFrom<N>(kRule<N>.node);
      const Lane<N> by_end[2] = {0.5 * (1.0 - node), 0.5 * (1.0 + node)};  // of psi, by tip, base
      for (int k = 0; k < W; ++k) c.d[k] = s.d[k] = by_x.d[k] = by_y.d[k] = Lane<N>{};
      for (int k = 0; k <= kBase; ++k) {
        const Lane<N>& turns = by_end[k == kBase ? 1 : 0];
        c.d[k] = -s.a * turns;
        s.d[k] = c.a * turns;
        by_x.d[k] = c0.d[k] - c.d[k];
        by_y.d[k] = s.d[k] - s0.d[k];
        square.d[k] = 2.0 * (fx.a * by_x.d[k] + fy.a * by_y.d[k]);
      }
      square.d[kX] = 2.0 * by_x.a;
      square.d[kY] = 2.0 * by_y.a;
    }
    over = InverseRoot(square);
    weight = over * half;
    weight.a *= rule;
    for (int k = 0; k < W; ++k) weight.d[k] *= rule;
  }
};

// How the tip turns on the toe so that the length stays: d(tip) = turn . (dfx, dfy, dPsi), from the
// length's slopes -kx, -ky, 1/kappa_b, and q k1 - 1 by the tip; -q is kappa dkappa/d(tip).
template <int W>
struct TipTurn {
  Number<W> q, turn[3];
};

// M68, M69. `whole` is what the fields below are taken of.
template <int N, int W>
void Comply(const Bending<N, W>& b, bool rolling, Response<Number<W>>& r, TipTurn<W>& tip) {
  const AtNodes<N, W> w = b.weight * (b.over * b.over), wx = w * b.by_x, wy = w * b.by_y;
  r.c11 = Sum(wx * b.by_x);
  r.c12 = Sum(wx * b.by_y);
  r.c22 = Sum(wy * b.by_y);
  r.h1 = (b.c0 - b.cb) * b.over_b;
  r.h2 = (b.sb - b.s0) * b.over_b;
  if (rolling) return;
  const Number<W> kx = Sum(wx), ky = Sum(wy), k1 = Sum(w);
  tip.q = b.fx * b.s0 + b.fy * b.c0;
  const Number<W> slope = tip.q * k1;
  const double inverse = 1.0 / (slope.a - 1.0);
  const Number<W> by_tip = Follow(slope, inverse, -inverse * inverse);
  tip.turn[0] = kx * by_tip;
  tip.turn[1] = ky * by_tip;
  tip.turn[2] = Number<W>() - b.over_b * by_tip;
  r.c11 = r.c11 - tip.q * kx * tip.turn[0];
  r.c12 = r.c12 - tip.q * kx * tip.turn[1];
  r.c22 = r.c22 - tip.q * ky * tip.turn[1];
  r.h1 = r.h1 + tip.q * kx * tip.turn[2];
  r.h2 = r.h2 + tip.q * ky * tip.turn[2];
}

// M71.
template <int N, int W>
void Dissipate(const Bending<N, W>& b, bool rolling, const TipTurn<W>& tip,
               Response<Number<W>>& r) {
  static const Tails<N> kTails;
  const AtNodes<N, W> cube = b.over * b.over * (b.over * b.half);
  const AtNodes<N, W> m = b.s * b.fx + b.c * b.fy;
  AtNodes<N, W> field[3] = {b.by_x * b.over - m * TailsOf(kTails, cube * b.by_x),
                            b.by_y * b.over - m * TailsOf(kTails, cube * b.by_y), m * b.over_b};
  if (!rolling) {
    const AtNodes<N, W> by_tip = (m * TailsOf(kTails, cube) - b.over) * tip.q;
    for (int k = 0; k < 3; ++k) field[k] = field[k] + by_tip * tip.turn[k];
  }
  int entry = 0;
  for (int j = 0; j < 3; ++j) {
    const AtNodes<N, W> weighed = b.weight * field[j];
    for (int k = j; k < 3; ++k) r.D[entry++] = Sum(weighed * field[k]);
  }
}

// The dissipation is asked for with fewer nodes (kDampingNodes).
template <int W>
Response<Number<W>> Respond(const Tangents& at, double fx, double fy, bool rolling,
                            bool dissipates) {
  Response<Number<W>> r;
  TipTurn<W> tip;
  if (!dissipates) {
    Comply(Bending<kNodes, W>(at, at.c, at.s, fx, fy), rolling, r, tip);
    return r;
  }
  double c[kDampingNodes], s[kDampingNodes];
  FillNodes<kDampingNodes>(0.5 * (at.base - at.tip), at.cos_middle, at.sin_middle, c, s);
  const Bending<kDampingNodes, W> bending(at, c, s, fx, fy);
  Comply(bending, rolling, r, tip);
  Dissipate(bending, rolling, tip, r);
  return r;
}

// A response in scalar type S.
template <class S, int W>
Response<S> In(const Response<Number<W>>& r) {
  const auto in = [](const Number<W>& x) {
    S y(x.a);
    if constexpr (kJetWidth < S >> 0)
      for (int k = 0; k < W; ++k) y.v[4 - W + k] = x.d[k];
    return y;
  };
  Response<S> out{in(r.c11), in(r.c12), in(r.c22), in(r.h1), in(r.h2), {}};
  for (std::size_t i = 0; i < out.D.size(); ++i) out.D[i] = in(r.D[i]);
  return out;
}

}  // namespace

HOPLAB_ON_EACH_CPU Response<double> ResponseOf(const Tangents& at, double fx, double fy,
                                               bool rolling, bool dissipates) {
  return In<double>(Respond<0>(at, fx, fy, rolling, dissipates));
}
// Rolling, the tip stays where it is: one slope less.
HOPLAB_ON_EACH_CPU Response<Jet<4>> ResponseTo1(const Tangents& at, double fx, double fy,
                                                bool rolling, bool dissipates) {
  if (rolling) return In<Jet<4>>(Respond<3>(at, fx, fy, true, dissipates));
  return In<Jet<4>>(Respond<4>(at, fx, fy, false, dissipates));
}

}  // namespace hoplab::clamped
