#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "model/laws/arc_shapes.h"
#include "model/laws/elastica/energy.h"
#include "model/laws/tangent.h"

namespace hoplab {

// Derivatives of the elastica's energy that a scalar asks for: M65 has the first ones, and every
// differentiation one more.
template <class S>
inline constexpr int kEnergyOrder = kJetWidth<S> == 0 ? 1 : 2;
template <class T>
inline constexpr int kEnergyOrder<Tangent<T>> = kEnergyOrder<T> + 1;
// A search in values comes back before it ends, nearer each time: the force and the energy it is
// told on its way may be off by what is squared at the next round.
template <class S>
inline constexpr bool kOfSearch = std::is_same_v<S, Tangent<double>>;
// The energy at a load, from what is known of it at one near by.
template <class S>
auto EnergyNear(double phi, double f, double f_known, elastica::Derivatives<2> known) {
  if constexpr (2 < kEnergyOrder<S>) {
    return elastica::EnergyTo3(phi, f);
  } else {
    constexpr double kNear = kOfSearch<S> ? 1e-8 : 1e-11;
    const double df = f - f_known;
    if (!(std::abs(df) < kNear)) return elastica::EnergyTo2(phi, f);
    known[0][0] += df * (known[0][1] + 0.5 * df * known[0][2]);
    known[0][1] += df * known[0][2];
    known[1][0] += df * known[1][1];
    return known;
  }
}

// The derivative [by x][by y] of a function of two variables, from all of them at their values.
template <class D>
double Lift2(double, double, const D& d, int i, int j) {
  return d[i][j];
}
template <int N, class D>
Jet<N> Lift2(const Jet<N>& x, const Jet<N>& y, const D& d, int i, int j) {
  return Jet<N>(d[i][j], d[i + 1][j] * x.v + d[i][j + 1] * y.v);
}
template <class T, class D>
Tangent<T> Lift2(const Tangent<T>& x, const Tangent<T>& y, const D& d, int i, int j) {
  const T by_x = Lift2(x.value, y.value, d, i + 1, j), by_y = Lift2(x.value, y.value, d, i, j + 1);
  return {Lift2(x.value, y.value, d, i, j), by_x * x.rate[0] + by_y * y.rate[0],
          by_x * x.rate[1] + by_y * y.rate[1]};
}

// What the elastica has beyond M2b at an arc and a load f (M65), from its energy there.
template <class S>
struct BeyondM2b {
  S chord;   // less chord, over r
  S turn;    // of the tip
  S energy;  // strain energy, over E I/r
};
template <class S, class Energy, class Bending, class Second>
BeyondM2b<S> BeyondM2bAt(const S& phi, const S& f, const Energy& d, const Bending& bending,
                         const Second& second) {
  const auto G = [&](int i, int j) { return Lift2(phi, f, d, i, j); };
  const auto first = [&](int k) { return Lift(phi, bending.data(), k); };
  const auto next = [&](int k) { return Lift(phi, second.data(), k); };
  const S f2 = f * f, G_f = G(0, 1);
  return {f * (2.0 * G(0, 0) + f * G_f - 0.5 * first(0)) - f2 * next(0),
          f * (G(1, 0) - 0.25 * first(1)) - (1.0 / 3.0) * (f2 * next(1)),
          f2 * (G(0, 0) + f * G_f - 0.25 * first(0) - (2.0 / 3.0) * (f * next(0)))};
}

// M121: what a torque at the hip adds to the chord, over r, and to the lead u/l, by what it adds at
// the values of an arc, a load f and a torque; `t`: how far the torque is from there.
template <class S>
struct BentByTorque {
  S chord, lead;
};
template <class S>
BentByTorque<S> BentByTorqueAt(const S& phi, const S& f, const S& t,
                               const elastica::TorqueBending& by) {
  const auto lifted = [&](const elastica::Derivatives<2>& d) { return Lift2(phi, f, d, 0, 0); };
  // The value of `t` is zero, so second derivatives of what it is multiplied by count for nothing.
  const auto lifted_slope = [&](const elastica::Derivatives<1>& d) {
    return lifted({{{d[0][0], d[0][1], 0.0}, {d[1][0], 0.0, 0.0}, {0.0, 0.0, 0.0}}});
  };
  if constexpr (kOfSearch<S>) {
    return {lifted(by.chord), lifted(by.lead)};
  } else {
    return {lifted(by.chord) + t * lifted_slope(by.chord_t),
            lifted(by.lead) + t * lifted_slope(by.lead_t)};
  }
}
template <class S>
elastica::TorqueBending TorqueBendingFor(double phi, double f, double t) {
  return kOfSearch<S> ? elastica::TorqueBendingOf(phi, f, t) : elastica::TorqueBendingAt(phi, f, t);
}
// The same at a load that is `df` more.
template <class S>
void MoveLoad(double phi, double f, double t, double df, elastica::TorqueBending& by) {
  if (!kOfSearch<S> && !(std::abs(df) < 1e-11)) {
    by = elastica::TorqueBendingAt(phi, f + df, t);
    return;
  }
  for (elastica::Derivatives<2>* d : {&by.chord, &by.lead}) {
    (*d)[0][0] += df * ((*d)[0][1] + 0.5 * df * (*d)[0][2]);
    (*d)[0][1] += df * (*d)[0][2];
    (*d)[1][0] += df * (*d)[1][1];
  }
}

// Of values alone: the chord, and how chord and turn go with phi and f; the energy goes by f times
// what the chord does.
struct SlopesBeyondM2b {
  double chord, chord_phi, chord_f, turn_f;
};
template <class Energy>
SlopesBeyondM2b SlopesAt(double f, const Energy& G, const ArcShapes& shapes) {
  const auto& first = shapes.bending;
  const auto& next = shapes.second_order;
  return {f * (2.0 * G[0][0] + f * G[0][1] - 0.5 * first[0] - f * next[0]),
          f * (2.0 * G[1][0] + f * G[1][1] - 0.5 * first[1] - f * next[1]),
          2.0 * G[0][0] + f * (4.0 * G[0][1] + f * G[0][2]) - 0.5 * first[0] - 2.0 * f * next[0],
          G[1][0] + f * G[1][1] - 0.25 * first[1] - (2.0 / 3.0) * f * next[1]};
}

}  // namespace hoplab
