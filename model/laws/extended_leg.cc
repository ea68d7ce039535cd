#include "model/laws/extended_leg.h"

#include <cmath>
#include <limits>
#include <optional>

#include "model/effects/effect.h"
#include "model/laws/extended_search.h"

namespace hoplab {
namespace {

using namespace extended;

// dphi/dt = along_u0 du0/dt + rest at an equilibrium, from the slopes of both residuals; along_y is
// what of `rest` goes with vy.
template <class T>
struct ArcRate {
  T along_u0, along_y, rest;
};
// `softened`: by how much tip_turn and F go with the softness.
template <class T>
ArcRate<T> RateOfArc(const Parameters<T>& p, Law law, const T* z, const Place<T>& here,
                     const Residuals<T>& by, const std::optional<LegForce<T>>& softened) {
  T tip_phi = by.by_phi.tip, ground_phi = by.by_phi.ground;
  if (IsElastic(law)) {
    const T outside = p.r + p.law_terms.sole;
    tip_phi += outside * by.by_u.tip;
    ground_phi += outside * by.by_u.ground;
  }
  T tip_rest(0.0), ground_rest = -z[kVy];  // what time does to both with phi, Y and u0 held
  if (softened) {
    const T softening = -p.law_terms.stiffness_drift * here.softer * here.softer;
    tip_rest += softening * softened->tip_turn;
    ground_rest -= p.law_terms.ground_compliance * (softening * softened->F * here.Y / Chord(here));
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
T RadiusOfM7(const T& r, const ThesisReading& reading, const T& sin, const T& cos, const T& l) {
  const bool at_rest = reading.rolling_radius == ThesisReading::RollingRadius::kRest;
  const T radius = at_rest ? T(2.0 * r * sin * cos) : T(l * cos);
  return reading.angle_rate == ThesisReading::AngleRate::kTheta ? radius : T(0.5 * radius);
}

template <class T>
T Softer(const Parameters<T>& p, const T& time) {
  return 1.0 / (1.0 + p.law_terms.stiffness_drift * (time + p.time_origin));
}

template <class T>
StaticsInputs<T> InputsOf(const Place<T>& at, const T& torque) {
  return {at.phi, Chord(at), torque, at.softer};
}

// The place of the solution: the residuals at the root in duals, the unknowns held (implicit
// function theorem).
template <class T>
Place<T> PlaceOf(const Parameters<T>& p, const Solution& solution, const Place<T>& held,
                 const LegForce<T>& leg, bool rolling, bool rolls_on_arc, const T& y) {
  const T l = Chord(held);
  const T tip = rolling ? T(held.u / l + leg.tip_turn) : T(0.0);
  const T ground = SinkMiss(p, leg.F, held, l, y);
  const auto& m = solution.inverse;
  Place<T> there = held;
  const T turned = m[0][0] * tip + m[0][1] * ground;
  there.phi -= turned;
  if (rolls_on_arc) there.u -= (p.r + p.law_terms.sole) * turned;
  there.Y -= m[1][0] * tip + m[1][1] * ground;
  return there;
}

// A leg at a place, before its force is known.
template <class T>
LegLoad<T> LoadAt(const Place<T>& there, const T* z) {
  LegLoad<T> load;
  load.u = there.u;
  load.y = there.Y;
  load.l = Chord(there);
  load.phi = there.phi;
  load.contact_rate = T(0.0);
  load.slip_gain = T(1.0);
  load.arc_x = load.arc_y = load.place_x = load.place_y = T(0.0);
  load.viscous_x = load.viscous_y = T(0.0);
  load.damping_rate = (there.Y * z[kVy] - load.u * z[kVx]) / load.l;  // M12
  return load;
}

// M38 of a chord that turns about a contact that stays.
template <class T>
void SetTurnOfChord(const T* z, LegLoad<T>& load) {
  load.angle_rate = -(load.y * z[kVx] + load.u * z[kVy]) / (load.l * load.l);
}

}  // namespace

template <class T>
LegLoad<T> ExtendedLeg<T>::Load(Mode mode, const T* z, const LegConditions<T>& at) const {
  const bool rolling = mode == Mode::kRolling, rolls_on_arc = rolling && IsElastic(law_);
  const T u0 = z[kContact] - z[kX];
  const T softer = Softer(p_, at.time);
  const Solution solution = Solve(
      {values_, law_, rolling, Value(u0), Value(z[kY]), Value(at.torque), Value(softer)}, root_);
  if (!solution.found) {
    const T nan(std::numeric_limits<double>::quiet_NaN());
    return {nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan};
  }
  const T phi(solution.phi);
  const Place<T> held{phi, rolls_on_arc ? T(u0 + (p_.r + p_.law_terms.sole) * phi) : u0,
                      T(solution.Y), softer};
  const StaticsInputs<double> values{solution.phi, Value(Chord(held)), Value(at.torque),
                                     Value(softer), solution.F};
  // The place in T's directions, by the statics evaluated there.
  const auto place = [&]([[maybe_unused]] const auto& leg) {
    if constexpr (kJetWidth < T >> 0)
      return PlaceOf(p_, solution, held, statics_->Force(leg, InputsOf(held, at.torque)), rolling,
                     rolls_on_arc, z[kY]);
    else
      return held;
  };
  const bool asked = p_.law_terms.slopes_active;
  const bool turns = rolling && (!IsElastic(law_) || p_.law_terms.rolling_active || asked);
  const bool has_hub = asked && law_ == Law::kElastica;
  if (!turns && !DampsAlongArc() && !has_hub) {
    const auto leg = statics_->At(values);
    const Place<T> there = place(leg);
    LegLoad<T> load = LoadAt(there, z);
    const LegForce<T> force = statics_->Force(leg, InputsOf(there, at.torque));
    load.elastic_force = force.F;
    load.tip_miss = load.u / load.l + force.tip_turn;
    if (!rolling && asked) SetTurnOfChord(z, load);
    return load;
  }
  const auto leg = statics_->Along(values);
  const Place<T> there = place(leg);
  LegLoad<T> load = LoadAt(there, z);
  const LegForceAlong<T> along = statics_->ForceAlong(leg, InputsOf(there, at.torque));
  load.elastic_force = along.F.value;
  load.tip_miss = load.u / load.l + along.tip_turn.value;
  if (!rolling && asked) SetTurnOfChord(z, load);
  if (turns) TurnContact(z, at, there, along, load);
  if (has_hub)
    TurnHub(rolling, z, along, load);
  else if (turns && p_.law_terms.uneven_active)
    load.angle_rate *= UnevenArc<T>(load.phi, p_.law_terms.uneven).turned_slope;
  if (DampsAlongArc()) AddViscousForce(softer, z, along.F, load);
  return load;
}

// M27: dx_c/dt = rho dphi/dt, the foot's creeping added by the caller; M34, M38.
template <class T>
void ExtendedLeg<T>::TurnContact(const T* z, const LegConditions<T>& at,
                                 const extended::Place<T>& there, const LegForceAlong<T>& along,
                                 LegLoad<T>& load) const {
  const T& blend = p_.law_terms.rolling;
  const ThesisReading reading = law_ == Law::kThesis ? p_.reading : ThesisReading();
  const T full = p_.r + p_.law_terms.sole, flat = RadiusOfM7(p_.r, reading, along.sin, along.cos,
                                                             load.l);  // M8, M11; M7
  const T rho = law_ == Law::kThesis ? T((1.0 - blend) * flat + blend * full)
                                     : T((1.0 - blend) * full + blend * flat);
  const T beyond = IsElastic(law_) ? T(rho - full) : rho;  // X0 moves by what is not rolled off
  std::optional<LegForce<T>> softened;
  if (!IsZero(p_.law_terms.stiffness_drift)) {
    StaticsInputs<T> inputs = InputsOf(there, at.torque);
    inputs.F_near = Value(along.F.value);
    softened = statics_->ForceBySoftness(inputs);
  }
  const ArcRate<T> rate =
      RateOfArc(p_, law_, z, there, ResidualsAt<T>(p_, there, z[kY], along), softened);
  if (reading.rolling == ThesisReading::Rolling::kImplicit)
    load.slip_gain = 1.0 / (1.0 - beyond * rate.along_u0);
  load.contact_rate = load.slip_gain * beyond * (rate.rest - rate.along_u0 * z[kVx]);
  if (p_.law_terms.slopes_active) {
    // M38: dphi/dt with du0/dt = dX0/dt - vx.
    load.angle_rate = -(rate.along_u0 * (load.contact_rate - z[kVx]) + rate.rest);
    const T gain = 1.0 + rate.along_u0 * load.slip_gain * beyond;
    load.arc_x = -gain * rate.along_u0;
    load.arc_y = gain * rate.along_y;
    load.place_x = rho * load.arc_x;
    load.place_y = rho * load.arc_y;
  }
  if (!IsElastic(law_) && reading.damping_rate != ThesisReading::DampingRate::kHip) {  // M34
    const T w = load.damping_rate;
    T seen = w + load.u * load.contact_rate / load.l;
    if (reading.damping_rate == ThesisReading::DampingRate::kDeflection)
      seen -= p_.r * along.cos * (rate.rest + rate.along_u0 * (load.contact_rate - z[kVx]));
    load.damping_rate = (1.0 - p_.law_terms.tip) * seen + p_.law_terms.tip * w;
  }
}

// M93. In: angle_rate of M38; out: that of the hub.
template <class T>
void ExtendedLeg<T>::TurnHub(bool rolling, const T* z, const LegForceAlong<T>& along,
                             LegLoad<T>& load) const {
  using std::sqrt;
  if (rolling) {
    const T &sole = p_.law_terms.sole, y = load.y - sole;  // over the line that bends
    const T arc_rate = -load.angle_rate;
    const T lead_rate = load.contact_rate + (p_.r + sole) * arc_rate - z[kVx];
    load.angle_rate = 2.0 * (y * lead_rate - load.u * z[kVy]) / (load.u * load.u + y * y);
    if (p_.law_terms.uneven_active)
      load.angle_rate -= 2.0 * UnevenTiltSlope(load.phi, p_.law_terms.uneven) * arc_rate;
    return;
  }
  const T& sine = along.tip_turn.value;  // less the sine of the tip's angle to the chord
  load.angle_rate -= along.tip_turn.rate[1] * load.damping_rate / sqrt(1.0 - sine * sine);
}

// M63: Rayleigh's function of the arc, and its force on the hip; F along the arc and the chord.
template <class T>
void ExtendedLeg<T>::AddViscousForce(const T& softer, const T* z, const Tangent<T>& F,
                                     LegLoad<T>& load) const {
  const T l_x = load.u * (load.place_x - 1.0) / load.l;
  const T l_y = (load.u * load.place_y + load.y) / load.l;
  const T stiffness = p_.E * p_.I / softer, per_N = p_.r * p_.r / stiffness;
  T f = per_N * F.value;
  T f_x = per_N * (F.rate[0] * load.arc_x + F.rate[1] * l_x);
  T f_y = per_N * (F.rate[0] * load.arc_y + F.rate[1] * l_y);
  if (p_.law_terms.HasOutline()) {  // what bends the strip
    const Outline<T> outline = OutlineAt(load.phi, p_.r, p_.law_terms);
    f_x = outline.spread * (f_x + outline.spread_slope * load.arc_x * f);
    f_y = outline.spread * (f_y + outline.spread_slope * load.arc_y * f);
    f = outline.spread * f;
  }
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
  const Statics<T> leg = statics_->Whole({load.phi, load.l, at.torque, Softer(p_, at.time)});
  const T lift = leg.F * load.y / load.l;
  const T ground = 0.5 * p_.law_terms.ground_compliance * lift * lift;
  if (IsElastic(law_)) {
    const T& bends = p_.law_terms.HasOutline() ? leg.soft_F : leg.F;
    return bends * bends * (0.5 * leg.C + 2.0 / 3.0 * bends * leg.A2) + leg.beyond + ground;
  }
  const T hardening = p_.law_terms.hardening / (law_ == Law::kStraightLeg ? p_.l0 : p_.r);
  const T& F = leg.soft_F;
  return F * F * (0.5 * leg.C + 2.0 / 3.0 * F * leg.A2) +
         hardening * leg.delta * leg.delta * leg.delta / (3.0 * leg.C) + ground;
}

template class ExtendedLeg<double>;
template class ExtendedLeg<Jet<1>>;
template class ExtendedLeg<Jet<kNarrowJet>>;
template class ExtendedLeg<Jet<kWideJet>>;
template class ExtendedLeg<Jet<kWidestJet>>;

}  // namespace hoplab
