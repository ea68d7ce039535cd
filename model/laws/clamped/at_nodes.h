#pragma once

#include <cmath>

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
// Sum over the nodes, in one order.
template <int N, int W>
Number<W> Sum(const AtNodes<N, W>& x) {
  Number<W> z;
  for (int i = 0; i < N; ++i) z.a += x.a[i];
  for (int k = 0; k < W; ++k)
    for (int i = 0; i < N; ++i) z.d[k] += x.d[k][i];
  return z;
}
// The integrals from each node to the end of the arc.
template <int N>
Lane<N> TailsOf(const Tails<N>& tails, const Lane<N>& x) {
  Lane<N> z = {};
  for (int j = 0; j < N; ++j) {
    Lane<N> tail;
    for (int i = 0; i < N; ++i) tail[i] = tails.of[j][i];
    z += tail * x[j];
  }
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
