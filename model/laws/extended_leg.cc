#include "model/laws/extended_leg.h"

#include <cmath>
#include <numbers>

#include "model/effects/effect.h"
#include "model/laws/extended_statics.h"

namespace hoplab {
namespace {

constexpr double kPi = std::numbers::pi;

// Arc and height at equilibrium, with the inverse of the matrix of slopes of the two residuals.
struct Solution {
  bool found = false;
  double phi, Y;
  double inverse[2][2];
};

struct Question {
  const Parameters<double>& p;
  Law law;
  bool rolling;  // phi is unknown: else it is the root's
  double u0, y, torque, softer;
};

Solution Solve(const Question& q, ExtendedRoot& root) {
  constexpr int kMaxRounds = 30;
  constexpr double kStepTolerance = 1e-11;  // the step after it is below rounding
  using Dual = Jet<4>;                      // directions phi, Y, u0, y
  double phi = root.phi, sink = root.sink;
  if (root.u0 == root.u0) {
    const double du = q.u0 - root.u0, dy = q.y - root.y;
    if (q.rolling) phi += root.phi_u0 * du + root.phi_y * dy;
    sink += root.sink_u0 * du + root.sink_y * dy;
  }
  const double roll = q.rolling && IsElastic(q.law) ? q.p.r : 0.0;
  Solution s;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (q.rolling) phi = std::fmin(std::fmax(phi, 0.05), 2.0 * kPi - 0.05);
    const Dual angle = Seeded<Dual>(phi, 0, 1.0);
    Situation<Dual> at{Seeded<Dual>(q.u0, 2, 1.0), Seeded<Dual>(q.y + sink, 1, 1.0),
                       Dual(q.softer)};
    if (roll != 0.0) at.u += roll * angle;
    const Statics<Dual> leg = StaticsAt<Dual, double>(q.p, q.law, q.torque, angle, at);
    const Dual tip = q.rolling ? leg.tip_miss : angle - phi;
    const Dual ground = SinkMiss<Dual, double>(q.p, leg, at, Seeded<Dual>(q.y, 3, 1.0));
    const double determinant = tip.v[0] * ground.v[1] - tip.v[1] * ground.v[0];
    s.inverse[0][0] = ground.v[1] / determinant;
    s.inverse[0][1] = -tip.v[1] / determinant;
    s.inverse[1][0] = -ground.v[0] / determinant;
    s.inverse[1][1] = tip.v[0] / determinant;
    const auto solved = [&](int row, double a, double b) {
      return -(s.inverse[row][0] * a + s.inverse[row][1] * b);
    };
    const double step = solved(0, tip.a, ground.a), deeper = solved(1, tip.a, ground.a);
    if (!std::isfinite(step) || !std::isfinite(deeper)) return s;
    phi += std::abs(step) < 0.5 ? step : std::copysign(0.5, step);
    sink += deeper;
    if (std::abs(step) < kStepTolerance && std::abs(deeper) < kStepTolerance * q.p.r) {
      root = {.phi = phi, .sink = sink, .u0 = q.u0, .y = q.y};
      root.phi_u0 = solved(0, tip.v[2], ground.v[2]);
      root.sink_u0 = solved(1, tip.v[2], ground.v[2]);
      root.phi_y = solved(0, tip.v[3], ground.v[3]);
      root.sink_y = solved(1, tip.v[3], ground.v[3]) - 1.0;
      s.found = true;
      s.phi = phi;
      s.Y = q.y + sink;
      return s;
    }
  }
  return s;
}

// Arc and contact lead of a leg that stands under torque alone (M30), with the inverse of the
// matrix of slopes of M10 and of the deflection left for the chord force.
struct Footing {
  bool found = false;
  double phi, u;
  double inverse[2][2];
};

// From a guess of both; q.u0 is not used, and phi keeps its value unless q.rolling.
Footing FindFooting(const Question& q, double phi, double u) {
  constexpr int kMaxRounds = 30;
  constexpr double kStepTolerance = 1e-11;
  using Dual = Jet<4>;  // directions phi, u
  Footing f;
  for (int round = 0; round < kMaxRounds; ++round) {
    const Dual angle = Seeded<Dual>(phi, 0, 1.0);
    const Statics<Dual> leg = StaticsAt<Dual, double>(
        q.p, q.law, q.torque, angle, {Seeded<Dual>(u, 1, 1.0), Dual(q.y), Dual(q.softer)});
    const Dual tip = q.rolling ? leg.tip_miss : angle - phi;
    const double determinant = tip.v[0] * leg.delta.v[1] - tip.v[1] * leg.delta.v[0];
    f.inverse[0][0] = leg.delta.v[1] / determinant;
    f.inverse[0][1] = -tip.v[1] / determinant;
    f.inverse[1][0] = -leg.delta.v[0] / determinant;
    f.inverse[1][1] = tip.v[0] / determinant;
    const double turn = f.inverse[0][0] * tip.a + f.inverse[0][1] * leg.delta.a;
    const double shift = f.inverse[1][0] * tip.a + f.inverse[1][1] * leg.delta.a;
    if (!std::isfinite(turn) || !std::isfinite(shift)) return f;
    phi -= turn;
    u -= shift;
    if (!(phi > 0.05 && phi < 2.0 * kPi - 0.05) || std::abs(u) > 2.0 * q.p.r) return f;
    if (std::abs(turn) < kStepTolerance && std::abs(shift) < kStepTolerance * q.p.r) {
      f.found = true;
      f.phi = phi;
      f.u = u;
      return f;
    }
  }
  return f;
}

// dphi/dt = along_u0 du0/dt + rest at an equilibrium, from the slopes of both residuals.
template <class T>
struct ArcRate {
  T along_u0, rest;
};
template <class T>
ArcRate<T> RateOfArc(const Parameters<T>& p, Law law, const LegConditions<T>& at, const T* z,
                     const T& phi, const T& Y, const T& softer) {
  using S = Tangent<T>;
  struct Slopes {
    T tip, ground;
  };
  struct Direction {
    T phi, Y, u0, y, softer;
  };
  const auto along = [&](const Direction& d) {
    const S angle(phi, d.phi);
    Situation<S> there{S(z[kContact] - z[kX], d.u0), S(Y, d.Y), S(softer, d.softer)};
    if (IsElastic(law)) there.u = there.u + p.r * angle;
    const Statics<S> leg = StaticsAt<S, T>(p, law, at.torque, angle, there);
    return Slopes{leg.tip_miss.rate, SinkMiss<S, T>(p, leg, there, S(z[kY], d.y)).rate};
  };
  const T one(1.0), zero(0.0);
  const Slopes by_phi = along({one, zero, zero, zero, zero});
  const Slopes by_Y = along({zero, one, zero, zero, zero});
  const Slopes by_u0 = along({zero, zero, one, zero, zero});
  const T softening = -p.law_terms.stiffness_drift * softer * softer;
  const Slopes by_rest = along({zero, zero, zero, z[kVy], softening});
  const T determinant = by_phi.tip * by_Y.ground - by_phi.ground * by_Y.tip;
  const auto solved = [&](const Slopes& s) {
    return T((by_Y.tip * s.ground - by_Y.ground * s.tip) / determinant);
  };
  return {solved(by_u0), solved(by_rest)};
}

// What dphi/dt is multiplied by in M7, with r_d = l/(2 sin(phi/2)), or in its readings M32, M33.
template <class T>
T RadiusOfM7(const T& r, const ThesisVariant& variant, const Statics<T>& leg) {
  const bool at_rest = variant.rolling_radius == ThesisVariant::RollingRadius::kRest;
  const T radius = at_rest ? T(2.0 * r * leg.sin * leg.cos) : T(leg.l * leg.cos);
  return variant.angle_rate == ThesisVariant::AngleRate::kTheta ? radius : T(0.5 * radius);
}

template <class T>
T Softer(const Parameters<T>& p, const T& time) {
  return 1.0 / (1.0 + p.law_terms.stiffness_drift * (time + p.time_origin));
}

}  // namespace

template <class T>
LegLoad<T> ExtendedLeg<T>::Load(Mode mode, const T* z, const LegConditions<T>& at) const {
  const bool rolling = mode == Mode::kRolling;
  const T u0 = z[kContact] - z[kX];
  const T softer = Softer(p_, at.time);
  LegLoad<T> load;
  const Solution solution = Solve(
      {values_, law_, rolling, Value(u0), Value(z[kY]), Value(at.torque), Value(softer)}, root_);
  if (!solution.found) {
    const T nan(std::numeric_limits<double>::quiet_NaN());
    return {nan, nan, nan, nan, nan, nan, nan, nan, nan};
  }

  // Implicit function theorem: residuals at the root in duals, the unknowns held.
  T phi(solution.phi), Y(solution.Y);
  const bool rolls_on_arc = rolling && IsElastic(law_);
  const auto here = [&] { return Situation<T>{rolls_on_arc ? T(u0 + p_.r * phi) : u0, Y, softer}; };
  if constexpr (kJetWidth < T >> 0) {
    const Situation<T> there = here();
    const Statics<T> leg = StaticsAt<T, T>(p_, law_, at.torque, phi, there);
    const T tip = rolling ? leg.tip_miss : T(0.0);
    const T ground = SinkMiss<T, T>(p_, leg, there, z[kY]);
    const auto& m = solution.inverse;
    phi -= m[0][0] * tip + m[0][1] * ground;
    Y -= m[1][0] * tip + m[1][1] * ground;
  }
  const Situation<T> there = here();
  const Statics<T> leg = StaticsAt<T, T>(p_, law_, at.torque, phi, there);
  load.u = there.u;
  load.y = Y;
  load.l = leg.l;
  load.phi = phi;
  load.elastic_force = leg.F;
  load.tip_miss = leg.tip_miss;
  load.contact_rate = T(0.0);
  load.slip_gain = T(1.0);
  const T w = (Y * z[kVy] - load.u * z[kVx]) / load.l;  // M12
  load.damping_rate = w;
  if (!rolling || (IsElastic(law_) && !p_.law_terms.rolling_active)) return load;

  // M27: dx_c/dt = rho dphi/dt, the foot's creeping added by the caller.
  const T& blend = p_.law_terms.rolling;
  const ThesisVariant variant = law_ == Law::kThesis ? p_.variant : ThesisVariant();
  const T full = p_.r, flat = RadiusOfM7(p_.r, variant, leg);  // M8, M11; M7
  const T rho = law_ == Law::kThesis ? T((1.0 - blend) * flat + blend * full)
                                     : T((1.0 - blend) * full + blend * flat);
  const T beyond = IsElastic(law_) ? T(rho - full) : rho;  // X0 moves by what is not rolled off
  const ArcRate<T> rate = RateOfArc(p_, law_, at, z, phi, Y, softer);
  if (variant.rolling == ThesisVariant::Rolling::kImplicit)
    load.slip_gain = 1.0 / (1.0 - beyond * rate.along_u0);
  load.contact_rate = load.slip_gain * beyond * (rate.rest - rate.along_u0 * z[kVx]);
  if (!IsElastic(law_) && variant.damping_rate != ThesisVariant::DampingRate::kHip) {  // M34
    T seen = w + load.u * load.contact_rate / load.l;
    if (variant.damping_rate == ThesisVariant::DampingRate::kDeflection)
      seen -= p_.r * leg.cos * (rate.rest + rate.along_u0 * (load.contact_rate - z[kVx]));
    load.damping_rate = (1.0 - p_.law_terms.tip) * seen + p_.law_terms.tip * w;
  }
  return load;
}

template <class T>
Mode ExtendedLeg<T>::Settle(Mode mode, T* z, const LegConditions<T>& at) {
  if (!p_.law_terms.torque_active) return mode;
  const T& y = z[kY];
  const T softer = Softer(p_, at.time);
  const bool elastic = IsElastic(law_);
  double phi = root_.phi;
  double u =
      mode == Mode::kRolling ? Value(p_.r) * std::sin(phi) : Value(z[kContact]) - Value(z[kX]);
  Footing footing = FindFooting(
      {values_, law_, mode == Mode::kRolling, 0.0, Value(y), Value(at.torque), Value(softer)}, phi,
      u);
  if (footing.found && footing.phi > kPi) {  // past the toe
    mode = Mode::kToe;
    footing = FindFooting({values_, law_, false, 0.0, Value(y), Value(at.torque), Value(softer)},
                          kPi, -0.5 * Value(p_.r));
  }
  if (!footing.found) return mode;
  T arc(footing.phi), lead(footing.u);
  if constexpr (kJetWidth < T >> 0) {
    const Statics<T> leg = StaticsAt<T, T>(p_, law_, at.torque, arc, {lead, y, softer});
    const T tip = mode == Mode::kRolling ? leg.tip_miss : T(0.0);
    const auto& m = footing.inverse;
    arc -= m[0][0] * tip + m[0][1] * leg.delta;
    lead -= m[1][0] * tip + m[1][1] * leg.delta;
  }
  z[kContact] = z[kX] + lead;
  if (elastic && mode == Mode::kRolling) z[kContact] -= p_.r * arc;
  StartRootAt(footing.phi);
  return mode;
}

template <class T>
T ExtendedLeg<T>::StrainEnergy(Mode, const LegLoad<T>& load, const LegConditions<T>& at) const {
  const Statics<T> leg =
      StaticsAt<T, T>(p_, law_, at.torque, load.phi, {load.u, load.y, Softer(p_, at.time)});
  const T lift = leg.F * load.y / load.l;
  const T ground = 0.5 * p_.law_terms.ground_compliance * lift * lift;
  if (IsElastic(law_)) return leg.F * leg.F * (0.5 * leg.C + 2.0 / 3.0 * leg.F * leg.A2) + ground;
  const T hardening = p_.law_terms.hardening / (law_ == Law::kStraightLeg ? p_.l0 : p_.r);
  const T& F = leg.soft_F;
  return F * F * (0.5 * leg.C + 2.0 / 3.0 * F * leg.A2) +
         hardening * leg.delta * leg.delta * leg.delta / (3.0 * leg.C) + ground;
}

template class ExtendedLeg<double>;
template class ExtendedLeg<Jet<1>>;
template class ExtendedLeg<Jet<kNarrowJet>>;
template class ExtendedLeg<Jet<kWideJet>>;

}  // namespace hoplab
