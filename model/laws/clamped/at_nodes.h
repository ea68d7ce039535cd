#pragma once

#include <cmath>
#include <cstring>

#include "model/laws/clamped/rule.h"

// Numbers with slopes, one or one at every node of a rule: laid out node by node, so that a
// processor works on several at once.

namespace hoplab::clamped {

// A number at every node; operators act node by node.
template <int N>
struct LaneOf {
  typedef double Type __attribute__((vector_size(N * sizeof(double))));
};
template <int N>
using Lane = typename LaneOf<N>::Type;
template <int N>
Lane<N> LaneFrom(const double* x) {
  Lane<N> z;
  std::memcpy(&z, x, sizeof(z));
  return z;
}

// The same with its slopes by the last W of (tip, base, fx, fy).
template <int N, int W>
struct AtNodes {
  Lane<N> a;
  Lane<N> d[W > 0 ? W : 1];
};

// A single number with those slopes.
template <int W>
struct Number {
  double a = 0.0;
  double d[W > 0 ? W : 1] = {};
};

template <int N, int W>
AtNodes<N, W> operator*(const AtNodes<N, W>& x, const AtNodes<N, W>& y) {
  AtNodes<N, W> z;
  z.a = x.a * y.a;
  for (int k = 0; k < W; ++k) z.d[k] = x.d[k] * y.a + x.a * y.d[k];
  return z;
}
template <int N, int W>
AtNodes<N, W> operator*(const AtNodes<N, W>& x, const Number<W>& y) {
  AtNodes<N, W> z;
  z.a = x.a * y.a;
  for (int k = 0; k < W; ++k) z.d[k] = x.d[k] * y.a + x.a * y.d[k];
  return z;
}
template <int N, int W>
AtNodes<N, W> operator+(const AtNodes<N, W>& x, const AtNodes<N, W>& y) {
  AtNodes<N, W> z;
  z.a = x.a + y.a;
  for (int k = 0; k < W; ++k) z.d[k] = x.d[k] + y.d[k];
  return z;
}
template <int N, int W>
AtNodes<N, W> operator-(const AtNodes<N, W>& x, const AtNodes<N, W>& y) {
  AtNodes<N, W> z;
  z.a = x.a - y.a;
  for (int k = 0; k < W; ++k) z.d[k] = x.d[k] - y.d[k];
  return z;
}
template <int W>
Number<W> operator*(const Number<W>& x, const Number<W>& y) {
  Number<W> z;
  z.a = x.a * y.a;
  for (int k = 0; k < W; ++k) z.d[k] = x.d[k] * y.a + x.a * y.d[k];
  return z;
}
template <int W>
Number<W> operator+(const Number<W>& x, const Number<W>& y) {
  Number<W> z;
  z.a = x.a + y.a;
  for (int k = 0; k < W; ++k) z.d[k] = x.d[k] + y.d[k];
  return z;
}
template <int W>
Number<W> operator-(const Number<W>& x, const Number<W>& y) {
  Number<W> z;
  z.a = x.a - y.a;
  for (int k = 0; k < W; ++k) z.d[k] = x.d[k] - y.d[k];
  return z;
}
// A function of x from its value and slope there.
template <int W>
Number<W> Follow(const Number<W>& x, double value, double slope) {
  Number<W> z;
  z.a = value;
  for (int k = 0; k < W; ++k) z.d[k] = slope * x.d[k];
  return z;
}
// 1/sqrt(x).
template <int N, int W>
AtNodes<N, W> InverseRoot(const AtNodes<N, W>& x) {
  AtNodes<N, W> z;
  for (int i = 0; i < N; ++i) z.a[i] = 1.0 / std::sqrt(x.a[i]);
  const Lane<N> slope = -0.5 * z.a * z.a * z.a;
  for (int k = 0; k < W; ++k) z.d[k] = slope * x.d[k];
  return z;
}
// Sum over the nodes: of halves, of halves of them, and so on, in this order on every processor.
template <int N>
double Sum(const Lane<N>& x) {
  if constexpr (N == 2) {
    return x[0] + x[1];
  } else {
    Lane<N / 2> half[2];
    static_assert(sizeof(half) == sizeof(x));
    std::memcpy(half, &x, sizeof(x));
    return Sum<N / 2>(half[0] + half[1]);
  }
}
template <int N, int W>
Number<W> Sum(const AtNodes<N, W>& x) {
  Number<W> z;
  z.a = Sum<N>(x.a);
  for (int k = 0; k < W; ++k) z.d[k] = Sum<N>(x.d[k]);
  return z;
}
// The least at any node.
template <int N>
double Least(const Lane<N>& x) {
  if constexpr (N == 1) {
    return x[0];
  } else {
    Lane<N / 2> half[2];
    std::memcpy(half, &x, sizeof(x));
    for (int i = 0; i < N / 2; ++i) half[0][i] = half[1][i] < half[0][i] ? half[1][i] : half[0][i];
    return Least<N / 2>(half[0]);
  }
}
// The integrals from each node to the end of the arc.
template <int N>
Lane<N> TailsOf(const Tails<N>& tails, const Lane<N>& x) {
  Lane<N> z = {};
  for (int j = 0; j < N; ++j) z += LaneFrom<N>(tails.of[j]) * x[j];
  return z;
}
template <int N, int W>
AtNodes<N, W> TailsOf(const Tails<N>& tails, const AtNodes<N, W>& x) {
  AtNodes<N, W> z;
  z.a = TailsOf<N>(tails, x.a);
  for (int k = 0; k < W; ++k) z.d[k] = TailsOf<N>(tails, x.d[k]);
  return z;
}

}  // namespace hoplab::clamped
