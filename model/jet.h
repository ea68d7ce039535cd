#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "ceres/jet.h"

namespace hoplab {

/// Dual number: a value and its derivatives in N directions. The only header that names the
/// third party it comes from.
template <int N>
using Jet = ceres::Jet<double, N>;

/// Widths of the dual numbers the simulator is built for; a run with more directions is cut into
/// chunks. Measured in docs/decisions/0002-sensitivities.md.
inline constexpr int kNarrowJet = 8;
inline constexpr int kWideJet = 12;
inline constexpr int kWidestJet = 20;

template <class T>
struct JetWidth : std::integral_constant<int, 0> {};
template <int N>
struct JetWidth<Jet<N>> : std::integral_constant<int, N> {};
/// Number of directions a scalar type carries: 0 for double, N for Jet<N>.
template <class T>
inline constexpr int kJetWidth = JetWidth<T>::value;

/// The value of a scalar, its directions dropped.
inline double Value(double x) { return x; }
template <int N>
double Value(const Jet<N>& x) {
  return x.a;
}

/// Derivative of `x` in direction `k`; 0 for a double.
inline double Slope(double, int) { return 0.0; }
template <int N>
double Slope(const Jet<N>& x, int k) {
  return x.v[k];
}

/// Zero, and zero in every direction: what depends on it can be left out.
inline bool IsZero(double x) { return x == 0.0; }
template <int N>
bool IsZero(const Jet<N>& x) {
  return x.a == 0.0 && x.v.isZero(0.0);
}

/// `value` with one direction seeded with `slope`.
template <class T>
T Seeded(double value, int k, double slope) {
  T x(value);
  if constexpr (kJetWidth < T >> 0) x.v[k] = slope;
  return x;
}

/// A function of `x` from its value and slope there: chain rule for functions solved in doubles.
inline double Chain(double, double value, double) { return value; }
template <int N>
Jet<N> Chain(const Jet<N>& x, double value, double slope) {
  return Jet<N>(value, slope * x.v);
}

/// Vector of the plane of motion, frame W (x forward, y up).
template <class T>
struct Vector2 {
  T x, y;
};

}  // namespace hoplab
