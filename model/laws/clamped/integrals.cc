#include "model/laws/clamped/integrals.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace hoplab::clamped {
namespace {

// Positive half of the nodes of the Gauss-Legendre rule in (-1, 1) with their weights.
template <int N>
struct HalfRule;
template <>
struct HalfRule<kNodes> {
  static constexpr double kNode[] = {
      0.095012509837637440, 0.281603550779258913, 0.458016777657227386, 0.617876244402643748,
      0.755404408355003034, 0.865631202387831744, 0.944575023073232576, 0.989400934991649933};
  static constexpr double kWeight[] = {
      0.189450610455068496, 0.182603415044923589, 0.169156519395002538, 0.149595988816576732,
      0.124628971255533872, 0.095158511682492785, 0.062253523938647893, 0.027152459411754095};
};
template <>
struct HalfRule<kDampingNodes> {
  static constexpr double kNode[] = {0.183434642495649805, 0.525532409916328986,
                                     0.796666477413626740, 0.960289856497536232};
  static constexpr double kWeight[] = {0.362683783378361983, 0.313706645877887287,
                                       0.222381034453374471, 0.101228536290376259};
};

// cos x = sum of kSeries[m] x^2m/..., with the factorials divided out one by one.
constexpr int kTerms = 14;
struct Series {
  double cosine[kTerms], sine[kTerms];
  constexpr Series() : cosine{1.0}, sine{1.0} {
    for (int m = 1; m < kTerms; ++m) {
      cosine[m] = -cosine[m - 1] / ((2.0 * m) * (2.0 * m - 1.0));
      sine[m] = -sine[m - 1] / ((2.0 * m + 1.0) * (2.0 * m));
    }
  }
};
constexpr Series kSeries;

// The whole rule, in ascending order.
template <int N>
struct Rule {
  double node[N]{}, weight[N]{};
  constexpr Rule() {
    constexpr int kHalf = N / 2;
    for (int i = 0; i < kHalf; ++i) {
      node[kHalf + i] = HalfRule<N>::kNode[i];
      node[kHalf - 1 - i] = -HalfRule<N>::kNode[i];
      weight[kHalf + i] = weight[kHalf - 1 - i] = HalfRule<N>::kWeight[i];
    }
  }
};
template <int N>
constexpr Rule<N> kRule;

// Cosine and sine at the nodes between the angles middle - half and middle + half: by the addition
// theorem from the middle of the arc; half of its angle is below 2.5, where the first term left out
// is 1e-18.
template <int N>
void FillNodes(double half, double cos_middle, double sin_middle, double* c, double* s) {
  constexpr int kHalf = N / 2;
  double q[kHalf], even[kHalf], odd[kHalf];
  // Up to half a turn of the arc fewer terms do as well.
  const int terms = std::abs(half) < 0.51 * std::numbers::pi ? kTerms - 3 : kTerms;
  for (int i = 0; i < kHalf; ++i) {
    const double x = half * HalfRule<N>::kNode[i];
    q[i] = x * x;
    even[i] = kSeries.cosine[terms - 1];
    odd[i] = kSeries.sine[terms - 1];
  }
  for (int m = terms - 2; m >= 0; --m) {
    for (int i = 0; i < kHalf; ++i) {
      even[i] = even[i] * q[i] + kSeries.cosine[m];
      odd[i] = odd[i] * q[i] + kSeries.sine[m];
    }
  }
  for (int i = 0; i < kHalf; ++i) {
    const double ci = even[i], si = odd[i] * half * HalfRule<N>::kNode[i];
    c[kHalf + i] = cos_middle * ci - sin_middle * si;
    s[kHalf + i] = sin_middle * ci + cos_middle * si;
    c[kHalf - 1 - i] = cos_middle * ci + sin_middle * si;
    s[kHalf - 1 - i] = sin_middle * ci - cos_middle * si;
  }
}

// The rule's matrix of the integrals from each node to the end of the arc, for (-1, 1), exact for
// polynomials of degree N - 1: [node summed over][node the integral begins at].
template <int N>
struct Tails {
  double of[N][N];

  Tails() {
    // Integrals of the Lagrange polynomials, each by the rule of the part it is taken over.
    for (int i = 0; i < N; ++i) {
      const double half = 0.5 * (1.0 - kRule<N>.node[i]), middle = 0.5 * (1.0 + kRule<N>.node[i]);
      for (int j = 0; j < N; ++j) {
        double sum = 0.0;
        for (int k = 0; k < N; ++k) {
          const double x = middle + half * kRule<N>.node[k];
          double lagrange = 1.0;
          for (int m = 0; m < N; ++m) {
            if (m != j) lagrange *= (x - kRule<N>.node[m]) / (kRule<N>.node[j] - kRule<N>.node[m]);
          }
          sum += kRule<N>.weight[k] * lagrange;
        }
        of[j][i] = half * sum;
      }
    }
  }
};

// Cosine and sine at the nodes in scalar type S: psi of a node moves with both ends of the arc.
template <class S, int N>
struct Nodes {
  S c[N], s[N];

  Nodes(const double* cosine, const double* sine) {
    for (int i = 0; i < N; ++i) {
      c[i] = S(cosine[i]);
      s[i] = S(sine[i]);
      if constexpr (kJetWidth < S >> 0) {
        const double by_tip = 0.5 * (1.0 - kRule<N>.node[i]),
                     by_base = 0.5 * (1.0 + kRule<N>.node[i]);
        c[i].v[0] = -sine[i] * by_tip;
        c[i].v[1] = -sine[i] * by_base;
        s[i].v[0] = cosine[i] * by_tip;
        s[i].v[1] = cosine[i] * by_base;
      }
    }
  }
};

// A number in scalar type S with slope 1 in direction k.
template <class S>
S Along(double value, int k) {
  return Seeded<S>(value, k, 1.0);
}

template <class S, int N>
Response<S> Respond(const Tangents& values, const Nodes<S, N>& at, double load_x, double load_y,
                    bool rolling, bool dissipates) {
  using std::sqrt;
  const S tip = Along<S>(values.tip, 0), base = Along<S>(values.base, 1);
  const S fx = Along<S>(load_x, 2), fy = Along<S>(load_y, 3), half = 0.5 * (base - tip);
  const S c0 = values.cos_tip - values.sin_tip * (tip - values.tip);
  const S s0 = values.sin_tip + values.cos_tip * (tip - values.tip);
  const S cb = values.cos_base - values.sin_base * (base - values.base);
  const S sb = values.sin_base + values.cos_base * (base - values.base);
  const S over_b = 1.0 / sqrt(1.0 + 2.0 * (fx * (c0 - cb) + fy * (sb - s0)));

  // Slopes of kappa^2/2 by fx and fy, and 1/kappa.
  S by_x[N], by_y[N], over[N], weight[N], cube[N];
  for (int i = 0; i < N; ++i) {
    by_x[i] = c0 - at.c[i];
    by_y[i] = at.s[i] - s0;
    cube[i] = 1.0 + 2.0 * (fx * by_x[i] + fy * by_y[i]);
  }
  for (int i = 0; i < N; ++i) over[i] = 1.0 / sqrt(cube[i]);
  for (int i = 0; i < N; ++i) {
    weight[i] = kRule<N>.weight[i] * half * over[i];
    cube[i] = over[i] * over[i] * over[i];
  }
  S k1(0.0), kxx(0.0), kxy(0.0), kyy(0.0), kx(0.0), ky(0.0);
  for (int i = 0; i < N; ++i) {
    const S w = weight[i] * over[i] * over[i], wx = w * by_x[i], wy = w * by_y[i];
    kxx += wx * by_x[i];
    kxy += wx * by_y[i];
    kyy += wy * by_y[i];
    if (rolling) continue;
    kx += wx;
    ky += wy;
    k1 += w;
  }
  Response<S> r;
  r.c11 = kxx;
  r.c12 = kxy;
  r.c22 = kyy;
  r.h1 = (c0 - cb) * over_b;
  r.h2 = (sb - s0) * over_b;
  // On the toe the tip turns so that the length stays: d(tip) = turn . (dfx, dfy, dPsi), from the
  // length's slopes -kx, -ky, 1/kappa_b, and q k1 - 1 by the tip; -q is kappa dkappa/d(tip).
  const S q = fx * s0 + fy * c0;
  S turn[3] = {S(0.0), S(0.0), S(0.0)};
  if (!rolling) {
    const S by_tip = 1.0 / (q * k1 - 1.0);
    turn[0] = kx * by_tip;
    turn[1] = ky * by_tip;
    turn[2] = -over_b * by_tip;
    r.c11 += -q * kx * turn[0];
    r.c12 += -q * kx * turn[1];
    r.c22 += -q * ky * turn[1];
    r.h1 += q * kx * turn[2];
    r.h2 += q * ky * turn[2];
  }
  if (!dissipates) return r;

  static const Tails<N> kTails;
  S tail_x[N], tail_y[N], tail_1[N];
  for (int i = 0; i < N; ++i) tail_x[i] = tail_y[i] = tail_1[i] = S(0.0);
  for (int j = 0; j < N; ++j) {
    const S w1 = half * cube[j], wx = w1 * by_x[j], wy = w1 * by_y[j];
    const double* tail = kTails.of[j];
    for (int i = 0; i < N; ++i) {
      tail_x[i] += tail[i] * wx;
      tail_y[i] += tail[i] * wy;
    }
    if (rolling) continue;
    for (int i = 0; i < N; ++i) tail_1[i] += tail[i] * w1;
  }
  S field[3][N];
  for (int i = 0; i < N; ++i) {
    const S m = fx * at.s[i] + fy * at.c[i];
    field[0][i] = by_x[i] * over[i] - m * tail_x[i];
    field[1][i] = by_y[i] * over[i] - m * tail_y[i];
    field[2][i] = m * over_b;
    if (!rolling) {
      const S by_tip = -q * (over[i] - m * tail_1[i]);
      for (int k = 0; k < 3; ++k) field[k][i] += by_tip * turn[k];
    }
  }
  for (S& d : r.D) d = S(0.0);
  for (int i = 0; i < N; ++i) {
    const S w = weight[i];
    int entry = 0;
    for (int j = 0; j < 3; ++j) {
      for (int k = j; k < 3; ++k) r.D[entry++] += w * field[j][i] * field[k][i];
    }
  }
  return r;
}

// The dissipation is asked for with fewer nodes (kDampingNodes).
template <class S>
Response<S> Respond(const Tangents& at, double fx, double fy, bool rolling, bool dissipates) {
  if (!dissipates) return Respond<S, kNodes>(at, {at.c, at.s}, fx, fy, rolling, false);
  double c[kDampingNodes], s[kDampingNodes];
  FillNodes<kDampingNodes>(0.5 * (at.base - at.tip), at.cos_middle, at.sin_middle, c, s);
  return Respond<S, kDampingNodes>(at, {c, s}, fx, fy, rolling, true);
}

}  // namespace

Tangents::Tangents(double tip_angle, double base_angle) : tip(tip_angle), base(base_angle) {
  const double middle = 0.5 * (base + tip);
  cos_middle = std::cos(middle);
  sin_middle = std::sin(middle);
  FillNodes<kNodes>(0.5 * (base - tip), cos_middle, sin_middle, c, s);
  if (tip == 0.0) {
    cos_base = 1.0 - 2.0 * sin_middle * sin_middle;
    sin_base = 2.0 * sin_middle * cos_middle;
    return;
  }
  cos_tip = std::cos(tip);
  sin_tip = std::sin(tip);
  cos_base = std::cos(base);
  sin_base = std::sin(base);
}

Integrals IntegralsOf(const Tangents& at, double fx, double fy) {
  const double half = 0.5 * (at.base - at.tip), x2 = 2.0 * fx, y2 = 2.0 * fy;
  const double level = 1.0 + x2 * at.cos_tip - y2 * at.sin_tip;
  double square[kNodes], over[kNodes], weight[kNodes], cube[kNodes];
  for (int i = 0; i < kNodes; ++i) square[i] = level + (y2 * at.s[i] - x2 * at.c[i]);
  double least = square[0];
  for (double q : square) least = q < least ? q : least;
  Integrals sum{};
  if (!(least > kLeastCurvature2)) {
    sum.one = std::numeric_limits<double>::quiet_NaN();
    return sum;
  }
  // Roots and quotients by themselves, so that they are taken in pairs.
  for (int i = 0; i < kNodes; ++i) over[i] = 1.0 / std::sqrt(square[i]);
  for (int i = 0; i < kNodes; ++i) {
    weight[i] = kRule<kNodes>.weight[i] * half * over[i];
    cube[i] = weight[i] * over[i] * over[i];
  }
  for (int i = 0; i < kNodes; ++i) {
    const double c = at.c[i], s = at.s[i], w = weight[i], w3 = cube[i];
    sum.one += w;
    sum.c += w * c;
    sum.s += w * s;
    sum.k1 += w3;
    sum.kc += w3 * c;
    sum.ks += w3 * s;
    sum.kcc += w3 * c * c;
    sum.kcs += w3 * c * s;
    sum.kss += w3 * s * s;
  }
  return sum;
}

Response<double> ResponseOf(const Tangents& at, double fx, double fy, bool rolling,
                            bool dissipates) {
  return Respond<double>(at, fx, fy, rolling, dissipates);
}
Response<Jet<4>> ResponseTo1(const Tangents& at, double fx, double fy, bool rolling,
                             bool dissipates) {
  return Respond<Jet<4>>(at, fx, fy, rolling, dissipates);
}

}  // namespace hoplab::clamped
