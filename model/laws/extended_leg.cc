#include "model/laws/extended_leg.h"

#include <cmath>
#include <numbers>

#include "model/effects/effect.h"
#include "model/laws/extended_statics.h"

namespace hoplab {
namespace {

constexpr double kPi = std::numbers::pi;

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
  double F_near = std::numeric_limits<double>::quiet_NaN();
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

// What the statics know: only phi and l.
template <class T>
Statics<Tangent<T>> StaticsAlong(const Parameters<T>& p, Law law, const T& torque,
                                 const Place<T>& at) {
  using S = Tangent<T>;
  const T one(1.0), zero(0.0);
  return StaticsAt<S, T>(p, law, torque,
                         {S(at.phi, one, zero), S(Chord(at), zero, one), S(at.softer), at.F_near});
}
// By the chain rule through the chord.
template <class T>
Residuals<T> ResidualsAt(const Parameters<T>& p, const Place<T>& at, const T& y,
                         const Statics<Tangent<T>>& leg) {
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

Solution Solve(const Question& q, ExtendedRoot& root) {
  constexpr int kMaxRounds = 30;
  constexpr double kStepTolerance = 1e-11;  // the step after it is below rounding
  double phi = root.phi, sink = root.sink;
  if (root.u0 == root.u0) {
    const double du = q.u0 - root.u0, dy = q.y - root.y;
    if (q.rolling) phi += root.phi_u0 * du + root.phi_y * dy;
    sink += root.sink_u0 * du + root.sink_y * dy;
  }
  const double roll = q.rolling && IsElastic(q.law) ? q.p.r : 0.0;
  const auto place = [&] { return Place<double>{phi, q.u0 + roll * phi, q.y + sink, q.softer}; };
  NearForce force = root.force;
  Solution s;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (q.rolling) phi = std::fmin(std::fmax(phi, 0.05), 2.0 * kPi - 0.05);
    Place<double> here = place();
    const double l = Chord(here);
    here.F_near = force.At(phi, l);
    Residuals<double> at =
        ResidualsAt<double>(q.p, here, q.y, StaticsAlong<double>(q.p, q.law, q.torque, here));
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

// dphi/dt = along_u0 du0/dt + rest at an equilibrium, from the slopes of both residuals; along_y is
// what of `rest` goes with vy.
template <class T>
struct ArcRate {
  T along_u0, along_y, rest;
};
template <class T>
ArcRate<T> RateOfArc(const Parameters<T>& p, Law law, const LegConditions<T>& at, const T* z,
                     const Place<T>& here, const Statics<Tangent<T>>& along) {
  const Residuals<T> by = ResidualsAt<T>(p, here, z[kY], along);
  T tip_phi = by.by_phi.tip, ground_phi = by.by_phi.ground;
  if (IsElastic(law)) {
    tip_phi += p.r * by.by_u.tip;
    ground_phi += p.r * by.by_u.ground;
  }
  T tip_rest(0.0), ground_rest = -z[kVy];  // what time does to both with phi, Y and u0 held
  if (!IsZero(p.law_terms.stiffness_drift)) {
    using S = Tangent<T>;
    const T softening = -p.law_terms.stiffness_drift * here.softer * here.softer, l = Chord(here);
    const Statics<S> leg = StaticsAt<S, T>(
        p, law, at.torque, {S(here.phi), S(l), S(here.softer, softening, T(0.0)), here.F_near});
    tip_rest += leg.tip_turn.rate[0];
    ground_rest -= p.law_terms.ground_compliance * (leg.F.rate[0] * here.Y / l);
  }
  const T determinant = tip_phi * by.by_Y.ground - ground_phi * by.by_Y.tip;
  const auto solved = [&](const T& tip, const T& ground) {
    return T((by.by_Y.tip * ground - by.by_Y.ground * tip) / determinant);
  };
  return {solved(by.by_u.tip, by.by_u.ground), solved(T(0.0), T(-1.0)),
          solved(tip_rest, ground_rest)};
}

// What dphi/dt is multiplied by in M7, with r_d = l/(2 sin(phi/2)), or in its readings M32, M33.
template <class T>
T RadiusOfM7(const T& r, const ThesisVariant& variant, const T& sin, const T& cos, const T& l) {
  const bool at_rest = variant.rolling_radius == ThesisVariant::RollingRadius::kRest;
  const T radius = at_rest ? T(2.0 * r * sin * cos) : T(l * cos);
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
    return {nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan};
  }

  // Implicit function theorem: residuals at the root in duals, the unknowns held.
  T phi(solution.phi), Y(solution.Y);
  const bool rolls_on_arc = rolling && IsElastic(law_);
  const auto here = [&] {
    return Place<T>{phi, rolls_on_arc ? T(u0 + p_.r * phi) : u0, Y, softer, solution.F};
  };
  if constexpr (kJetWidth < T >> 0) {
    const Place<T> held = here();
    const T l = Chord(held);
    const Statics<T> leg = StaticsAt<T, T>(p_, law_, at.torque, {phi, l, softer, solution.F});
    const T tip = rolling ? T(held.u / l + leg.tip_turn) : T(0.0);
    const T ground = SinkMiss(p_, leg.F, held, l, z[kY]);
    const auto& m = solution.inverse;
    phi -= m[0][0] * tip + m[0][1] * ground;
    Y -= m[1][0] * tip + m[1][1] * ground;
  }
  const Place<T> there = here();
  load.u = there.u;
  load.y = Y;
  load.l = Chord(there);
  load.phi = phi;
  load.contact_rate = T(0.0);
  load.slip_gain = T(1.0);
  load.arc_x = load.arc_y = load.place_x = load.place_y = T(0.0);
  load.viscous_x = load.viscous_y = T(0.0);
  const T w = (Y * z[kVy] - load.u * z[kVx]) / load.l;  // M12
  load.damping_rate = w;
  const bool asked = p_.law_terms.slopes_active;
  const bool turns = rolling && (!IsElastic(law_) || p_.law_terms.rolling_active || asked);
  const auto carries = [&](const T& F, const T& tip_turn) {
    load.elastic_force = F;
    load.tip_miss = load.u / load.l + tip_turn;
  };
  if (!turns && !DampsAlongArc()) {
    const Statics<T> leg = StaticsAt<T, T>(p_, law_, at.torque, {phi, load.l, softer, solution.F});
    carries(leg.F, leg.tip_turn);
    // M38 of a chord that turns about a contact that stays.
    if (!rolling && asked) load.angle_rate = -(Y * z[kVx] + load.u * z[kVy]) / (load.l * load.l);
    return load;
  }
  const Statics<Tangent<T>> along = StaticsAlong(p_, law_, at.torque, there);
  carries(along.F.value, along.tip_turn.value);
  if (!turns) {
    if (!rolling && asked) load.angle_rate = -(Y * z[kVx] + load.u * z[kVy]) / (load.l * load.l);
    AddViscousForce(softer, z, along.F, load);
    return load;
  }

  // M27: dx_c/dt = rho dphi/dt, the foot's creeping added by the caller.
  const T& blend = p_.law_terms.rolling;
  const ThesisVariant variant = law_ == Law::kThesis ? p_.variant : ThesisVariant();
  const T full = p_.r, flat = RadiusOfM7(p_.r, variant, along.sin.value, along.cos.value,
                                         load.l);  // M8, M11; M7
  const T rho = law_ == Law::kThesis ? T((1.0 - blend) * flat + blend * full)
                                     : T((1.0 - blend) * full + blend * flat);
  const T beyond = IsElastic(law_) ? T(rho - full) : rho;  // X0 moves by what is not rolled off
  const ArcRate<T> rate = RateOfArc(p_, law_, at, z, there, along);
  if (variant.rolling == ThesisVariant::Rolling::kImplicit)
    load.slip_gain = 1.0 / (1.0 - beyond * rate.along_u0);
  load.contact_rate = load.slip_gain * beyond * (rate.rest - rate.along_u0 * z[kVx]);
  if (asked) {
    // M38: dphi/dt with du0/dt = dX0/dt - vx.
    load.angle_rate = -(rate.along_u0 * (load.contact_rate - z[kVx]) + rate.rest);
    const T gain = 1.0 + rate.along_u0 * load.slip_gain * beyond;
    load.arc_x = -gain * rate.along_u0;
    load.arc_y = gain * rate.along_y;
    load.place_x = rho * load.arc_x;
    load.place_y = rho * load.arc_y;
  }
  if (DampsAlongArc()) AddViscousForce(softer, z, along.F, load);
  if (!IsElastic(law_) && variant.damping_rate != ThesisVariant::DampingRate::kHip) {  // M34
    T seen = w + load.u * load.contact_rate / load.l;
    if (variant.damping_rate == ThesisVariant::DampingRate::kDeflection)
      seen -= p_.r * along.cos.value * (rate.rest + rate.along_u0 * (load.contact_rate - z[kVx]));
    load.damping_rate = (1.0 - p_.law_terms.tip) * seen + p_.law_terms.tip * w;
  }
  return load;
}

// M63: Rayleigh's function of the arc, and its force on the hip; F along the arc and the chord.
template <class T>
void ExtendedLeg<T>::AddViscousForce(const T& softer, const T* z, const Tangent<T>& F,
                                     LegLoad<T>& load) const {
  const T l_x = load.u * (load.place_x - 1.0) / load.l;
  const T l_y = (load.u * load.place_y + load.y) / load.l;
  const T stiffness = p_.E * p_.I / softer, per_N = p_.r * p_.r / stiffness;
  const T f = per_N * F.value;
  const T f_x = per_N * (F.rate[0] * load.arc_x + F.rate[1] * l_x);
  const T f_y = per_N * (F.rate[0] * load.arc_y + F.rate[1] * l_y);
  const double phi0 = Value(load.phi), f0 = Value(f);
  const elastica::Dissipation table = elastica::DissipationAt(phi0, f0);
  const auto lift = [&](const elastica::Derivatives<1>& d) {
    return T(d[0][0] + d[1][0] * (load.phi - phi0) + d[0][1] * (f - f0));
  };
  const T ff = lift(table.ff), mixed = lift(table.fphi), phiphi = lift(table.phiphi);
  const T f_rate = f_x * z[kVx] + f_y * z[kVy];
  const T phi_rate = load.arc_x * z[kVx] + load.arc_y * z[kVy];
  const T unit = p_.law_terms.material_damping * stiffness / p_.r;
  const T by_load = unit * (ff * f_rate + mixed * phi_rate);
  const T by_arc = unit * (mixed * f_rate + phiphi * phi_rate);
  load.viscous_x = -(by_load * f_x + by_arc * load.arc_x);
  load.viscous_y = -(by_load * f_y + by_arc * load.arc_y);
}

template <class T>
T ExtendedLeg<T>::StrainEnergy(Mode, const LegLoad<T>& load, const LegConditions<T>& at) const {
  const Statics<T> leg =
      StaticsAt<T, T>(p_, law_, at.torque, {load.phi, load.l, Softer(p_, at.time)});
  const T lift = leg.F * load.y / load.l;
  const T ground = 0.5 * p_.law_terms.ground_compliance * lift * lift;
  if (IsElastic(law_))
    return leg.F * leg.F * (0.5 * leg.C + 2.0 / 3.0 * leg.F * leg.A2) + leg.beyond + ground;
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
