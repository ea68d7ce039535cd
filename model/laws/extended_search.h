#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/laws/extended_leg.h"
#include "model/laws/extended_statics.h"

// Where an extended leg is at rest under its load: Newton in doubles. Of extended_leg.cc alone.

namespace hoplab::extended {

// What M10 and M28 lack of zero at a contact arc phi, a lead u and a height Y of the hip over the
// contact, and their slopes there.
template <class T>
struct Residuals {
  struct Pair {
    T tip, ground;
  };
  Pair miss, by_phi, by_u, by_Y;
  Tangent<T> F;  // along the arc and the chord

  explicit Residuals(const Tangent<T>& force) : F(force) {}
};

template <class T>
struct Place {
  T phi, u, Y, softer;
};

template <class T>
T Chord(const Place<T>& at) {
  using std::sqrt;
  return sqrt(at.u * at.u + at.Y * at.Y);
}

// M28: the ground under the foot sinks by c_g times the elastic part of the vertical force.
template <class T>
T SinkMiss(const Parameters<T>& p, const T& F, const Place<T>& at, const T& l, const T& y) {
  return at.Y - y - p.law_terms.ground_compliance * (F * at.Y / l);
}

// By the chain rule through the chord. `leg`: tip_turn and F along the arc and the chord.
template <class T, class Leg>
Residuals<T> ResidualsAt(const Parameters<T>& p, const Place<T>& at, const T& y, const Leg& leg) {
  const T l = Chord(at);
  const T by_l = 1.0 / l, lead = at.u * by_l, height = at.Y * by_l;
  const T& F = leg.F.value;
  const T sinking = p.law_terms.ground_compliance * height;
  const T tip_l = leg.tip_turn.rate[1] - lead * by_l;
  const T ground_l = -sinking * (leg.F.rate[1] - F * by_l);
  Residuals<T> out(leg.F);
  out.miss = {lead + leg.tip_turn.value, SinkMiss(p, F, at, l, y)};
  out.by_phi = {leg.tip_turn.rate[0], -sinking * leg.F.rate[0]};
  out.by_u = {by_l + tip_l * lead, ground_l * lead};
  out.by_Y = {tip_l * height, 1.0 - p.law_terms.ground_compliance * (F * by_l) + ground_l * height};
  return out;
}

// Arc and height at equilibrium, with the inverse of the matrix of slopes of the two residuals.
struct Solution {
  bool found = false;
  double phi, Y;
  double F;
  double inverse[2][2];
};

struct Question {
  const Parameters<double>& p;
  Law law;
  bool rolling;  // phi is unknown: else it is the root's
  double u0, y, torque, softer;
};

inline Solution Solve(const Question& q, ExtendedRoot& root) {
  constexpr int kMaxRounds = 30;
  constexpr double kStepTolerance = 1e-11;  // the step after it is below rounding
  double phi = root.phi, sink = root.sink;
  if (root.u0 == root.u0) {
    const double du = q.u0 - root.u0, dy = q.y - root.y;
    if (q.rolling) phi += root.phi_u0 * du + root.phi_y * dy;
    sink += root.sink_u0 * du + root.sink_y * dy;
  }
  const double roll = q.rolling && IsElastic(q.law) ? q.p.r + q.p.law_terms.sole : 0.0;
  const auto place = [&] { return Place<double>{phi, q.u0 + roll * phi, q.y + sink, q.softer}; };
  NearForce force = root.force;
  Solution s;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (q.rolling) phi = std::fmin(std::fmax(phi, 0.05), 2.0 * std::numbers::pi - 0.05);
    const Place<double> here = place();
    const double l = Chord(here);
    using S = Tangent<double>;
    const Situation<S> situation{S(phi, 1.0, 0.0), S(l, 0.0, 1.0), S(q.softer), force.At(phi, l)};
    Residuals<double> at =
        ResidualsAt<double>(q.p, here, q.y, StaticsAt<S, double>(q.p, q.law, q.torque, situation));
    force = {phi, l, at.F.value, at.F.rate[0], at.F.rate[1]};
    at.by_phi.tip += roll * at.by_u.tip;
    at.by_phi.ground += roll * at.by_u.ground;
    if (!q.rolling) {  // phi stays
      at.miss.tip = at.by_u.tip = at.by_Y.tip = 0.0;
      at.by_phi.tip = 1.0;
    }
    const double determinant = at.by_phi.tip * at.by_Y.ground - at.by_phi.ground * at.by_Y.tip;
    s.inverse[0][0] = at.by_Y.ground / determinant;
    s.inverse[0][1] = -at.by_Y.tip / determinant;
    s.inverse[1][0] = -at.by_phi.ground / determinant;
    s.inverse[1][1] = at.by_phi.tip / determinant;
    const auto solved = [&](int row, double a, double b) {
      return -(s.inverse[row][0] * a + s.inverse[row][1] * b);
    };
    const double step = solved(0, at.miss.tip, at.miss.ground);
    const double deeper = solved(1, at.miss.tip, at.miss.ground);
    if (!std::isfinite(step) || !std::isfinite(deeper)) return s;
    phi += std::abs(step) < 0.5 ? step : std::copysign(0.5, step);
    sink += deeper;
    if (std::abs(step) < kStepTolerance && std::abs(deeper) < kStepTolerance * q.p.r) {
      root = {.phi = phi, .sink = sink, .u0 = q.u0, .y = q.y};
      root.phi_u0 = solved(0, at.by_u.tip, at.by_u.ground);
      root.sink_u0 = solved(1, at.by_u.tip, at.by_u.ground);
      root.phi_y = solved(0, 0.0, -1.0);
      root.sink_y = solved(1, 0.0, -1.0) - 1.0;
      root.force = force;
      s.found = true;
      s.phi = phi;
      s.Y = q.y + sink;
      s.F = force.At(phi, Chord(place()));
      return s;
    }
  }
  return s;
}

}  // namespace hoplab::extended
