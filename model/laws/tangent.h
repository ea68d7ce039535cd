#pragma once

#include <array>
#include <cmath>

#include "model/jet.h"

namespace hoplab {

// A value and its rates of change in two directions, over a scalar that carries directions itself:
// the second derivatives in the rates of M7 and M8.
template <class T>
struct Tangent {
  T value;
  std::array<T, 2> rate{T(0.0), T(0.0)};

  Tangent(const T& v) : value(v) {}  // NOLINT: a constant is a tangent with rates 0
  Tangent(const T& v, const T& first, const T& second) : value(v), rate{first, second} {}

  friend Tangent operator+(const Tangent& a, const Tangent& b) {
    return {a.value + b.value, a.rate[0] + b.rate[0], a.rate[1] + b.rate[1]};
  }
  friend Tangent operator-(const Tangent& a, const Tangent& b) {
    return {a.value - b.value, a.rate[0] - b.rate[0], a.rate[1] - b.rate[1]};
  }
  friend Tangent operator*(const Tangent& a, const Tangent& b) {
    return {a.value * b.value, a.rate[0] * b.value + a.value * b.rate[0],
            a.rate[1] * b.value + a.value * b.rate[1]};
  }
  // A factor that does not move.
  friend Tangent operator*(const T& a, const Tangent& b) {
    return {a * b.value, a * b.rate[0], a * b.rate[1]};
  }
  friend Tangent operator*(const Tangent& a, const T& b) { return b * a; }
  friend Tangent operator*(double a, const Tangent& b) requires(kJetWidth<T> > 0) {
    return {a * b.value, a * b.rate[0], a * b.rate[1]};
  }
  friend Tangent operator/(const Tangent& a, const Tangent& b) {
    const T q = a.value / b.value;
    return {q, (a.rate[0] - q * b.rate[0]) / b.value, (a.rate[1] - q * b.rate[1]) / b.value};
  }
  friend Tangent sqrt(const Tangent& a) {
    using std::sqrt;
    const T root = sqrt(a.value), half = 0.5 / root;
    return {root, half * a.rate[0], half * a.rate[1]};
  }
  friend double Value(const Tangent& a) { return hoplab::Value(a.value); }
};

template <class>
inline constexpr bool kIsTangent = false;
template <class T>
inline constexpr bool kIsTangent<Tangent<T>> = true;

}  // namespace hoplab
