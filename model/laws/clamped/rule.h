#pragma once

#include <cmath>
#include <numbers>

#include "model/laws/clamped/integrals.h"

// The Gauss-Legendre rules along an arc.

namespace hoplab::clamped {

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
static_assert(kTerms % 2 == 0);  // they are summed in pairs
inline constexpr Series kSeries;

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
inline constexpr Rule<N> kRule;

// Cosine and sine at the nodes between the angles middle - half and middle + half: by the addition
// theorem from the middle of the arc; half of its angle is below 2.5, where the first term left out
// is 1e-18.
template <int N>
void FillNodes(double half, double cos_middle, double sin_middle, double* c, double* s) {
  constexpr int kHalf = N / 2;
  // Of each series every second term, and the others: sums that a processor takes side by side.
  double q[kHalf], q2[kHalf], cosine[2][kHalf], sine[2][kHalf];
  // Up to half a turn of the arc fewer terms do as well.
  const int terms = std::abs(half) < 0.51 * std::numbers::pi ? kTerms - 2 : kTerms;
  for (int i = 0; i < kHalf; ++i) {
    const double x = half * HalfRule<N>::kNode[i];
    q[i] = x * x;
    q2[i] = q[i] * q[i];
    for (int k = 0; k < 2; ++k) {
      cosine[k][i] = kSeries.cosine[terms - 2 + k];
      sine[k][i] = kSeries.sine[terms - 2 + k];
    }
  }
  for (int m = terms - 4; m >= 0; m -= 2) {
    for (int k = 0; k < 2; ++k)
      for (int i = 0; i < kHalf; ++i) {
        cosine[k][i] = cosine[k][i] * q2[i] + kSeries.cosine[m + k];
        sine[k][i] = sine[k][i] * q2[i] + kSeries.sine[m + k];
      }
  }
  for (int i = 0; i < kHalf; ++i) {
    const double ci = cosine[0][i] + q[i] * cosine[1][i],
                 si = (sine[0][i] + q[i] * sine[1][i]) * half * HalfRule<N>::kNode[i];
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

}  // namespace hoplab::clamped
