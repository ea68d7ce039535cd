#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/mechanisms/heavy_leg_inl.h"
#include "model/mechanisms/legged_body.h"

namespace hoplab {

template <class T, class LegT>
LeggedBody<T, LegT>::LeggedBody(const MechanismSetup<T>& setup)
    : p_(ParametersOf(setup)),
      effects_(setup.effects),
      liftoff_(setup.liftoff),
      lagged_(Value(p_.torque_lag) >= kShortestLag),
      has_body_force_(effects_.HasBodyForce() || setup.inputs.HasForce()),
      has_chord_force_(effects_.HasChordForce()),
      has_hip_torque_(effects_.HasHipTorque()),
      has_hip_formula_(effects_.HasHipFormula()),
      has_joint_torque_(effects_.HasJointTorque()),
      is_driven_(has_hip_torque_ || has_joint_torque_ || lagged_ || !IsZero(p_.kp) ||
                 setup.inputs.Has(InputKind::kHipTorque)),
      has_quick_lag_(!lagged_ && !IsZero(p_.torque_lag)),
      // The touch-down angle moves in flight if it depends on a speed that does.
      flies_freely_(!has_body_force_ && !setup.inputs.Has(InputKind::kLegAngle) &&
                    !effects_.TouchdownAngleFalls() &&
                    (IsZero(p_.slope) || !effects_.HasTouchdownAngle())),
      extended_(p_.law_terms.active),
      is_bar_(setup.law == Law::kStraightLeg),
      has_leg_mass_(p_.law_terms.leg_mass_active),
      has_foot_friction_(p_.law_terms.foot_friction_active),
      foot_has_inertia_(has_leg_mass_ && has_foot_friction_ && !p_.on_guide &&
                        Value(p_.law_terms.foot_friction) > kLeastFriction &&
                        Value(p_.law_terms.leg_mass) > kLeastFootShare * Value(p_.m)),
      damps_along_arc_(DampsAlongArc(setup)),
      may_pull_(p_.law_terms.torque_active),
      torque_lift_(p_.variant.torque_sign == ThesisVariant::TorqueSign::kPrinted ? -1.0 : 1.0),
      inertia_(p_),
      leg_(setup.law, p_),
      controller_(p_),
      y_min_(std::isnan(p_.fall_height) ? leg_->LowestHip() : T(p_.fall_height)),
      start_angle_(std::isnan(p_.start_angle) ? p_.theta_td : T(p_.start_angle)),
      inputs_(setup.inputs),
      angles_(setup.touchdown_angles),
      driven_(!setup.inputs.empty()) {}

// A leg that knows its curvature damps along its arc, unless it swings with a mass at its toe.
template <class T, class LegT>
bool LeggedBody<T, LegT>::DampsAlongArc(const MechanismSetup<T>& setup) {
  return setup.law == Law::kElastica && setup.parameters.law_terms.material_damping_active &&
         IsZero(setup.parameters.m_toe);
}
template <class T, class LegT>
Parameters<T> LeggedBody<T, LegT>::ParametersOf(const MechanismSetup<T>& setup) {
  Parameters<T> p = setup.parameters;
  if (DampsAlongArc(setup)) p.law_terms.active = p.law_terms.slopes_active = true;
  return p;
}

template <class T, class LegT>
void LeggedBody<T, LegT>::SaveDiscreteState(DiscreteState& to) const {
  leg_->SaveDiscreteState(to);
  to.Put(controller_.saturation());
  to.Put(landings_);
  to.Put(sinks_ ? 1.0 : 0.0);
  to.Put(slides_);
  if (driven_) inputs_.Save(to);
  effects_.SaveCorners(to);
}
template <class T, class LegT>
void LeggedBody<T, LegT>::LoadDiscreteState(DiscreteState& from) {
  leg_->LoadDiscreteState(from);
  controller_.set_saturation(static_cast<int>(from.Take()));
  landings_ = static_cast<int>(from.Take());
  sinks_ = from.Take() > 0.5;
  slides_ = from.Take();
  if (driven_) inputs_.Load(from);
  effects_.LoadCorners(from);
}

template <class T, class LegT>
Mode LeggedBody<T, LegT>::Begin(Mode mode, T* z) {
  sinks_ = Value(z[kVy]) <= 0.0;
  slides_ = 0.0;
  swing_time_ = T(0.0);
  if (foot_has_inertia_) z[FootSpeed()] = T(0.0);
  if (mode != Mode::kFlight) {
    controller_.Enter(Value(z[kVx]));
    if (lagged_) z[kMotorTorque] = CommandedTorque(T(0.0), z);
    mode = PlaceContact(mode, z);
    const bool is_pushed = foot_has_inertia_ && (Pushes(mode, T(0.0), z) ||
                                                 Value(Load(mode, T(0.0), z).damping_rate) > 0.0);
    if (is_pushed && !HoldsWithin(mode, T(0.0), z)) BeginSlide(mode, T(0.0), z);
  }
  Seat(mode, T(0.0), z);
  return mode;
}

// ---- corners of formulas -------------------------------------------------------------------

template <class T, class LegT>
template <class Act>
void LeggedBody<T, LegT>::WithMotionsAt(Mode mode, const T& t, const T* z, const Act& act) const {
  if (mode == Mode::kFlight) return WithMotions(mode, t, z, nullptr, nullptr, act);
  const LegLoad<T> load = Load(mode, t, z);
  const ChordMotion<T> chord = ChordMotionAt(load, t);
  const HipMotion<T> hip = HipMotionAt(mode, MotorTorque(t, z), load, t, z);
  WithMotions(mode, t, z, &chord, &hip, act);
}
template <class T, class LegT>
void LeggedBody<T, LegT>::Seat(Mode mode, const T& t, const T* z) {
  if (effects_.corner_count() == 0) return;
  WithMotionsAt(mode, t, z, [&](const Motions<T>& m) { effects_.SeatCorners(m); });
}

// M54: the contact coordinate for which the contact lies where z[kContact] says. First in values,
// by Newton with a difference for a slope, then once in T.
template <class T, class LegT>
Mode LeggedBody<T, LegT>::PlaceContact(Mode mode, T* z) {
  const T place = z[kContact];
  const double alpha = std::atan2(Value(place - z[kX]), Value(z[kY]));
  const auto stand = [&](bool rolling) {
    constexpr double kLeast = 1e-3;  // rad, of a leg that rolls
    const T theta(rolling ? std::max(2.0 * alpha, kLeast) : std::min(alpha, 0.0));
    const Mode landed = leg_->Land(theta, z);
    z[kContact] += place - (z[kX] + Lead(theta));
    return landed;
  };
  const bool has_modes = leg_->OwnGuardCount(Mode::kToe) > 0;
  bool rolls = mode == Mode::kRolling;
  if (mode == Mode::kStance && has_modes) {
    T own[kMaxGuards];
    const Mode toe = stand(false);
    leg_->OwnGuards(toe, Load(toe, T(0.0), z), own);
    rolls = !(Value(own[0]) > 0.0);
  }
  const Mode landed = stand(rolls);
  const auto miss = [&](const T& coordinate) {
    z[kContact] = coordinate;
    return T(z[kX] + Load(landed, T(0.0), z).u - place);
  };
  const double size = leg_->Size(), step = 1e-6 * size;
  double at = Value(z[kContact]), slope = 1.0;
  constexpr int kMostRounds = 30;
  for (int round = 0; round < kMostRounds; ++round) {
    const double off = Value(miss(T(at)));
    slope = (Value(miss(T(at + step))) - Value(miss(T(at - step)))) / (2.0 * step);
    if (!std::isfinite(off) || !std::isfinite(slope) || slope == 0.0) break;
    at -= off / slope;
    if (std::abs(off) < 1e-13 * size) break;
  }
  const T off = miss(T(at));
  z[kContact] = at - (off - Value(off)) / slope;
  return landed;
}

template <class T, class LegT>
std::optional<T> LeggedBody<T, LegT>::PassKnot(Mode mode, double t, T* z) {
  const bool flight = mode == Mode::kFlight;
  const std::optional<InputKind> due = inputs_.Due(flight, t);
  if (due == InputKind::kHipTorque && has_quick_lag_) {
    // M52: a motor that lags by t_lag gives t_lag times the jump less than its command, at once.
    const T missed = p_.torque_lag * inputs_.of(InputKind::kHipTorque).NextJump();
    const LegLoad<T> load = Load(mode, T(t), z);
    const T normal = missed / (load.l * load.l);
    if (!inertia_.on_guide) z[kVx] -= normal * load.y / inertia_.mx;
    z[kVy] -= torque_lift_ * normal * load.u / inertia_.my;
    Seat(mode, T(t), z);
  }
  return inputs_.Pass(flight, t);
}

template <class T, class LegT>
void LeggedBody<T, LegT>::Derivative(Mode mode, const T& t, const T* z, T* dz) const {
  T fx(0.0), fy(0.0);
  T contact_rate(0.0);
  LegLoad<T> load;
  if (mode != Mode::kFlight) {
    load = Load(mode, t, z);
    const Vector2<T> force = HipForce(load, HipTorque(mode, load, t, z), t);
    fx = force.x;
    fy = force.y;
    contact_rate = load.contact_rate;
    if (extended_) contact_rate -= load.slip_gain * p_.law_terms.foot_slip * force.x;  // M29
  }
  if (has_body_force_) {
    const Vector2<T> force = BodyForce(mode, t, z);
    fx += force.x;
    fy += force.y;
  }
  dz[kX] = z[kVx];
  dz[kY] = z[kVy];
  dz[kVx] = inertia_.on_guide ? T(0.0) : T(fx / inertia_.mx + inertia_.gravity_x);  // M13
  dz[kVy] = fy / inertia_.my + inertia_.gravity_y;                                  // M14
  dz[kContact] = contact_rate;
  if (foot_has_inertia_) dz[FootSpeed()] = T(0.0);
  if (has_leg_mass_ && mode != Mode::kFlight) {
    if (slides_ != 0.0) {
      SlidingAcceleration(load, {fx, fy}, mode, t, z, dz);
    } else {
      const Vector2<T> rate = HeavyAcceleration(load, {fx, fy}, z);
      dz[kVx] = rate.x;
      dz[kVy] = rate.y;
    }
  }
  if (!lagged_) return;
  dz[kMotorTorque] = T(0.0);
  if (mode != Mode::kFlight)
    dz[kMotorTorque] = (CommandedTorque(t, z) - z[kMotorTorque]) / p_.torque_lag;
}

// Guards in flight: touch-down, apex, the ground under a hip whose leg is not placed. Guards in
// stance: lift-off, the leg's own, fall by height, fall by angle, a foot that slips
// away, torque limit. Behind both the corners of formulas. Of two at one instant the first fires
// first.
template <class T, class LegT>
int LeggedBody<T, LegT>::GuardCount(Mode mode) const {
  return OwnGuardCount(mode) + effects_.corner_count();
}
template <class T, class LegT>
int LeggedBody<T, LegT>::OwnGuardCount(Mode mode) const {
  if (mode == Mode::kFlight) return 3;
  return 3 + leg_->OwnGuardCount(mode) + (has_foot_friction_ ? 1 : 0) +
         (controller_.limited() ? 1 : 0);
}

template <class T, class LegT>
GuardSpec LeggedBody<T, LegT>::Guard(Mode mode, int i) const {
  if (const int corner = i - OwnGuardCount(mode); corner >= 0) return effects_.CornerSpec(corner);
  const double weight = Value(p_.m) * std::max(Value(p_.g), 1.0), length = leg_->Size();
  if (mode == Mode::kFlight) {
    if (i == 0) return {EventKind::kTouchdown, length};
    return i == 1 ? GuardSpec{EventKind::kApex, 1.0} : GuardSpec{EventKind::kFallHeight, length};
  }
  if (i == 0)
    return {EventKind::kLiftoff, liftoff_ == LiftoffRule::kZeroForce ? weight : length,
            may_pull_ ? std::nullopt : std::optional(Outcome::kNoSupport)};
  const int own = leg_->OwnGuardCount(mode);
  if (i <= own) return leg_->OwnGuard(mode, i - 1);
  switch (i - own) {
    case 1:
      return {EventKind::kFallHeight, length, Outcome::kFellHeight};
    case 2:
      return {EventKind::kFallAngle, 1.0, Outcome::kFellAngle};
    case 3:
      if (foot_has_inertia_) {
        if (slides_ != 0.0) return {EventKind::kStick, 1.0};
        return {EventKind::kSlide, weight};
      }
      if (has_foot_friction_) return {EventKind::kLiftoff, 1.0, Outcome::kNoSupport};
      [[fallthrough]];
    default:
      return {EventKind::kTorqueLimit, controller_.limit()};
  }
}

/// Guard functions, all crossing zero downward; the table of section 4.
template <class T, class LegT>
void LeggedBody<T, LegT>::Guards(Mode mode, const T& t, const T* z, T* g) const {
  if (mode == Mode::kFlight) {
    const T touchdown = TouchdownHeight(t, z);
    // A leg that a log moves swings through the ground while the hip rises (M51).
    g[0] = sinks_ ? T(z[kY] - touchdown) : T(1.0);
    g[1] = z[kVy];
    g[2] = FallsBelow(touchdown) ? T(z[kY] - y_min_) : T(1.0);
    if (effects_.corner_count() > 0)
      WithMotions(mode, t, z, nullptr, nullptr,
                  [&](const Motions<T>& m) { effects_.CornerGuards(m, g + 3); });
    return;
  }
  const LegLoad<T> load = Load(mode, t, z);
  g[0] =
      liftoff_ == LiftoffRule::kZeroForce ? ChordForce(load, t) : T(leg_->RestChord(load) - load.l);
  StanceGuards(mode, load, t, z, g);
}

template <class T, class LegT>
void LeggedBody<T, LegT>::StanceGuards(Mode mode, const LegLoad<T>& load, const T& t, const T* z,
                                       T* g) const {
  leg_->OwnGuards(mode, load, g + 1);
  g += 1 + leg_->OwnGuardCount(mode);
  g[0] = z[kY] - y_min_;
  g[1] = load.y / load.l - kFallCosine;
  g += 2;
  if (foot_has_inertia_) {  // M87
    *g++ = slides_ != 0.0 ? T(slides_ * z[FootSpeed()]) : ConeMargin(mode, load, t, z);
  } else if (has_foot_friction_) {  // M64
    const T slope = load.u / load.y;
    *g++ = 1.0 - p_.law_terms.foot_friction * (Value(slope) < 0.0 ? T(-slope) : slope);
  }
  if (controller_.limited()) *g++ = controller_.Guard(z[kVx]);
  if (effects_.corner_count() == 0) return;
  const ChordMotion<T> chord = ChordMotionAt(load, t);
  const HipMotion<T> hip = HipMotionAt(mode, MotorTorque(t, z), load, t, z);
  WithMotions(mode, t, z, &chord, &hip, [&](const Motions<T>& m) { effects_.CornerGuards(m, g); });
}

template <class T, class LegT>
ResetResult LeggedBody<T, LegT>::Reset(Mode mode, int i, const T& t, T* z) {
  if (const int corner = i - OwnGuardCount(mode); corner >= 0) {
    WithMotionsAt(mode, t, z, [&](const Motions<T>& m) { effects_.CrossCorner(corner, m); });
    return {mode};
  }
  const bool is_section = TraitsOf(Guard(mode, i).event).is_section;
  const ResetResult result = ResetOwn(mode, i, t, z);
  if (!is_section && !result.end) Seat(result.next, t, z);
  return result;
}

template <class T, class LegT>
ResetResult LeggedBody<T, LegT>::ResetOwn(Mode mode, int i, const T& t, T* z) {
  const EventKind event = Guard(mode, i).event;
  if (foot_has_inertia_ && mode != Mode::kFlight && i - leg_->OwnGuardCount(mode) == 3) {
    ResetFoot(event, mode, t, z);
    return {mode};
  }
  switch (event) {
    case EventKind::kTouchdown:
      return Land(SweptAngle(t, z), t, z, T(0.0));
    case EventKind::kLiftoff:
      if (has_leg_mass_) LeaveWithLeg(Load(mode, t, z), t, z);
      if (effects_.HasLiftoffVelocity()) ApplyLiftoff(Load(mode, t, z), z);
      z[kContact] = T(0.0);
      if (foot_has_inertia_) LetFootGo(z);
      inputs_.Seek(Value(t));
      sinks_ = !inputs_.Has(InputKind::kLegAngle) || Value(z[kVy]) <= 0.0;
      return {Mode::kFlight};
    case EventKind::kApex:
      sinks_ = true;
      return {.next = mode, .is_hop = Value(z[kY] - TouchdownHeight(t, z)) >= 0.0};
    case EventKind::kTorqueLimit:
      controller_.Cross(Value(z[kVx]));
      return {mode};
    case EventKind::kFallHeight:
      return {mode, mode == Mode::kFlight ? Outcome::kFellNoReturn : Outcome::kFellHeight};
    case EventKind::kFallAngle:
      return {mode, Outcome::kFellAngle};
    case EventKind::kFallArc:
      return {mode, Outcome::kFellArc};
    default:
      return {leg_->ResetStance(event, z)};
  }
}

template <class T, class LegT>
BallisticFlight<T> LeggedBody<T, LegT>::Ballistic(const T* z) const {
  const T touchdown = TouchdownHeight(T(0.0), z);
  BallisticFlight<T> flight{inertia_.gravity_x, inertia_.gravity_y, touchdown};
  if (FallsBelow(touchdown)) flight.floor = Value(y_min_);
  return flight;
}
template <class T, class LegT>
std::optional<BallisticFlight<T>> LeggedBody<T, LegT>::FreeFlight() const {
  return BallisticFlight<T>{inertia_.gravity_x, inertia_.gravity_y};
}

/// First step of a mode [s]: in stance a tenth of a radian of the undamped oscillation, and no
/// more than a lag of the torque.
template <class T, class LegT>
double LeggedBody<T, LegT>::FirstStep(Mode mode, const T* z) const {
  if (mode == Mode::kFlight) return 0.01;
  const double step = 0.1 * leg_->TimeScale(Load(mode, T(0.0), z));
  return lagged_ ? std::min(step, Value(p_.torque_lag)) : step;
}

template <class T, class LegT>
Observation<T> LeggedBody<T, LegT>::Observe(Mode mode, const T& t, const T* z) const {
  Observation<T> seen = this->Unseen();
  seen[Channel::kBodyX] = z[kX];
  seen[Channel::kBodyY] = z[kY];
  seen[Channel::kBodyVx] = z[kVx];
  seen[Channel::kBodyVy] = z[kVy];
  if (mode == Mode::kFlight) {
    const T theta = TouchdownAngle(t, z);
    seen[Channel::kContactX] = z[kX] + Lead(theta);
    seen[Channel::kContactY] = T(0.0);
    seen[Channel::kLegAngle] = theta;
    seen[Channel::kLegLength] = leg_->ShownLength(theta);
    for (Channel c :
         {Channel::kGroundForceX, Channel::kGroundForceY, Channel::kHipTorque, Channel::kContact})
      seen[c] = T(0.0);
    if (has_leg_mass_) AddSwing(t, seen);
    return seen;
  }
  const LegLoad<T> load = Load(mode, t, z);
  const T torque = HipTorque(mode, load, t, z);
  const Vector2<T> force = HipForce(load, torque, t);
  seen[Channel::kLegAngle] = leg_->ShownAngle(mode, load);
  seen[Channel::kLegLength] = load.l;
  seen[Channel::kGroundForceX] = force.x;
  seen[Channel::kGroundForceY] = force.y;
  seen[Channel::kHipTorque] = torque;
  seen[Channel::kContact] = T(1.0);
  seen[Channel::kContactX] = z[kX] + load.u;
  seen[Channel::kContactY] = z[kY] - load.y;
  seen[Channel::kContactArc] = leg_->ShownArc(load);
  return seen;
}

template <class T, class LegT>
T LeggedBody<T, LegT>::Energy(Mode mode, const T* z) const {
  T energy = inertia_.Energy(z);
  const auto weigh = [&](const LegInertia<T>& leg) {
    energy += p_.law_terms.leg_mass / p_.m *
              (inertia_.weight_along * leg.x.value + inertia_.weight_down * leg.y.value);
  };
  if (mode == Mode::kFlight) {
    if (has_leg_mass_) weigh(InertiaOfLeg(Placed(TouchdownAngle(z))));
    return energy;
  }
  const LegLoad<T> load = Load(mode, T(0.0), z);
  if (has_leg_mass_) {
    energy += KineticEnergyOfLeg(load, z);
    weigh(InertiaOfLeg(load));
  }
  if (extended_) return energy + leg_->extended().StrainEnergy(mode, load, Conditions(T(0.0), z));
  return energy + leg_->StrainEnergy(load);
}

template <class T, class LegT>
double LeggedBody<T, LegT>::DeflectionRatio(Mode mode, const double* values) const {
  if (mode == Mode::kFlight || !leg_->IsExpansion()) return 0.0;
  T z[kMostLegStates];
  for (int i = 0; i < size(); ++i) z[i] = T(values[i]);
  return leg_->DeflectionRatio(Load(mode, T(0.0), z));
}

template <class T, class LegT>
ResetResult LeggedBody<T, LegT>::Land(const T& theta, const T& t, T* z, const T& ahead) {
  const Mode stance = leg_->Land(theta, z);
  z[kContact] += ahead;
  ApplyLanding(theta, z);
  controller_.Enter(Value(z[kVx]));
  ++landings_;
  inputs_.Seek(Value(t));
  if (lagged_) z[kMotorTorque] = CommandedTorque(t, z);
  slides_ = 0.0;
  if (has_leg_mass_) TakeLegAlong(Load(stance, t, z), z);
  // What the leg itself presses brings an unloaded foot into its cone at once; a torque does not.
  if (foot_has_inertia_ && slides_ == 0.0 && Pushes(stance, t, z) && !HoldsWithin(stance, t, z))
    BeginSlide(stance, t, z);
  return {stance};
}

template <class T, class LegT>
LegLoad<T> LeggedBody<T, LegT>::Load(Mode mode, const T& t, const T* z) const {
  if (slides_ != 0.0) {  // the leg feels the hip move over its foot
    T over[kMostLegStates];
    std::copy_n(z, size(), over);
    over[kVx] -= z[FootSpeed()];
    LegLoad<T> load =
        extended_ ? leg_->extended().Load(mode, over, Conditions(t, z)) : leg_->Load(mode, over);
    load.contact_rate += z[FootSpeed()];
    return load;
  }
  if (extended_) return leg_->extended().Load(mode, z, Conditions(t, z));
  return leg_->Load(mode, z);
}

template <class T, class LegT>
ChordMotion<T> LeggedBody<T, LegT>::ChordMotionAt(const LegLoad<T>& load, const T& t) const {
  const T rest = leg_->RestChord(load);
  return {load.elastic_force, leg_->Stiffness(load), load.damping_rate, T((rest - load.l) / rest),
          SinceFirstRow(t)};
}

template <class T, class LegT>
T LeggedBody<T, LegT>::ChordForce(const LegLoad<T>& load, const T& t) const {
  T force = load.elastic_force - p_.d * load.damping_rate;  // M6, M12
  if (damps_along_arc_)
    force += (load.y * load.viscous_y - load.u * load.viscous_x) / load.l;
  else if (p_.law_terms.material_damping_active)
    force -= p_.law_terms.material_damping * leg_->Stiffness(load) * load.damping_rate;
  if (has_chord_force_) force += effects_.ChordForce(ChordMotionAt(load, t));
  return force;
}

template <class T, class LegT>
T LeggedBody<T, LegT>::TouchdownAngle(const T& t, const T* z) const {
  T commanded = landings_ == 0 ? start_angle_ : p_.theta_td;
  if (inputs_.Has(InputKind::kLegAngle)) {
    commanded = inputs_.At(InputKind::kLegAngle, t);
    commanded -= 2.0 * std::numbers::pi * std::round(Value(commanded) / (2.0 * std::numbers::pi));
  } else if (!angles_.empty()) {
    commanded = angles_[std::min(static_cast<std::size_t>(landings_), angles_.size() - 1)];
  }
  return effects_.TouchdownAngle(PlacementAt(z), commanded) - p_.slope;
}
template <class T, class LegT>
T LeggedBody<T, LegT>::TouchdownHeight(const T& t, const T* z) const {
  return effects_.ContactHeight(leg_->TouchdownHeight(TouchdownAngle(t, z)));
}
// M51: the angle a leg touches down at. One whose command jumps into the ground swings there at
// once, and lands at the angle on its way at which it meets it.
template <class T, class LegT>
T LeggedBody<T, LegT>::SweptAngle(const T& t, const T* z) const {
  const T commanded = TouchdownAngle(t, z);
  const InputSignal<T>& angle = inputs_.of(InputKind::kLegAngle);
  const double size = leg_->Size();
  const auto above = [&](double theta) {
    return Value(z[kY]) - Value(effects_.ContactHeight(leg_->TouchdownHeight(T(theta))));
  };
  if (!angle.present() || !angle.held() || above(Value(commanded)) > -1e-9 * size) return commanded;
  double down = Value(commanded), up = down - Value(angle.At(t)) + Value(angle.Before());
  if (!(above(up) > 0.0)) return commanded;
  constexpr int kRounds = 100;
  for (int i = 0; i < kRounds; ++i) {
    const double middle = 0.5 * (up + down);
    (above(middle) > 0.0 ? up : down) = middle;
  }
  // Its derivative: the height there must stay the hip's.
  const T theta(0.5 * (up + down));
  const double step = 1e-6;
  const double slope = (above(Value(theta) + step) - above(Value(theta) - step)) / (2.0 * step);
  const T off = z[kY] - effects_.ContactHeight(leg_->TouchdownHeight(theta));
  return theta - (off - Value(off)) / slope;
}
template <class T, class LegT>
T LeggedBody<T, LegT>::Lead(const T& theta) const {
  using std::sin;
  return leg_->ShownLength(theta) * sin(leg_->ChordAngle(theta));
}
template <class T, class LegT>
Vector2<T> LeggedBody<T, LegT>::BodyForce(Mode mode, const T& t, const T* z) const {
  Vector2<T> force = effects_.BodyForce(BodyMotionAt(mode, t, z));
  AddInputForce(inputs_, p_.slope, t, force);
  return force;
}
template <class T, class LegT>
void LeggedBody<T, LegT>::ApplyLiftoff(const LegLoad<T>& load, T* z) const {
  Vector2<T> velocity{z[kVx], z[kVy]};
  effects_.ChangeLiftoffVelocity({{-load.u / load.l, load.y / load.l}}, velocity);
  z[kVx] = velocity.x;
  z[kVy] = velocity.y;
}

// Whether a hip below touch-down height falls on before it counts as fallen. (A leg that lands
// nearly lying has its hip below y_min there: that is a fall of stance.)
template <class T, class LegT>
bool LeggedBody<T, LegT>::FallsBelow(const T& touchdown) const {
  return Value(y_min_) < Value(touchdown);
}

// The torque that bends the leg; friction at the hip, which would have to know the load first, is
// not in it.
template <class T, class LegT>
LegConditions<T> LeggedBody<T, LegT>::Conditions(const T& t, const T* z) const {
  T torque = MotorTorque(t, z);
  if (has_hip_torque_) effects_.AddHipTorque({torque, SinceFirstRow(t), z[kVx]}, torque, false);
  return {t, torque};
}
// What the motor gives: its command, or with a lag long enough to integrate a state.
template <class T, class LegT>
T LeggedBody<T, LegT>::MotorTorque(const T& t, const T* z) const {
  return lagged_ ? z[kMotorTorque] : CommandedTorque(t, z);
}
// What the motor is told: by the controller, or as logged (M52).
template <class T, class LegT>
T LeggedBody<T, LegT>::CommandedTorque(const T& t, const T* z) const {
  return inputs_.Has(InputKind::kHipTorque) ? inputs_.At(InputKind::kHipTorque, t)
                                            : controller_.Torque(z[kVx]);
}
// Torque on the hip: the motor's, and what effects add.
template <class T, class LegT>
T LeggedBody<T, LegT>::HipTorque(Mode mode, const LegLoad<T>& load, const T& t, const T* z) const {
  if (!is_driven_) return T(0.0);
  const T motor = MotorTorque(t, z);
  if (!has_quick_lag_) return WithTorqueEffects(mode, motor, load, t, z);
  // A lag too short to integrate, to its first order: T_cmd - t_lag dT_cmd/dt.
  T fx = HipForce(load, WithTorqueEffects(mode, motor, load, t, z), t).x;
  if (has_body_force_) fx += BodyForce(mode, t, z).x;
  const T rate = inputs_.Has(InputKind::kHipTorque)
                     ? inputs_.of(InputKind::kHipTorque).Rate()
                     : controller_.TorqueRate(fx / inertia_.mx + inertia_.gravity_x);
  return WithTorqueEffects(mode, motor - p_.torque_lag * rate, load, t, z);
}
template <class T, class LegT>
HipMotion<T> LeggedBody<T, LegT>::HipMotionAt(Mode mode, const T& torque, const LegLoad<T>& load,
                                              const T& t, const T* z) const {
  HipMotion<T> hip{torque, SinceFirstRow(t), z[kVx], load.u / load.l};
  if (has_hip_formula_) {
    const T rest = leg_->RestChord(load);
    hip.angle = leg_->ShownAngle(mode, load);
    hip.rate = load.angle_rate;
    hip.compression = (rest - load.l) / rest;
  }
  return hip;
}
template <class T, class LegT>
T LeggedBody<T, LegT>::WithTorqueEffects(Mode mode, T torque, const LegLoad<T>& load, const T& t,
                                         const T* z) const {
  if (has_hip_torque_) effects_.AddHipTorque(HipMotionAt(mode, torque, load, t, z), torque);
  if (has_joint_torque_) torque += effects_.JointTorque({load.angle_rate});
  return torque;
}
// What a touch-down at leg angle `theta` does to the velocity.
template <class T, class LegT>
void LeggedBody<T, LegT>::ApplyLanding(const T& theta, T* z) const {
  using std::cos;
  using std::sin;
  const T alpha = leg_->ChordAngle(theta);
  Vector2<T> velocity{z[kVx], z[kVy]};
  effects_.ChangeLandingVelocity({{-sin(alpha), cos(alpha)}, theta}, velocity);
  z[kVx] = velocity.x;
  z[kVy] = velocity.y;
}
// F e + (T/l) n, the bracket of M13 and M14 (M37); by reaction, the ground's force on the leg.
template <class T, class LegT>
Vector2<T> LeggedBody<T, LegT>::HipForce(const LegLoad<T>& load, const T& torque,
                                         const T& t) const {
  const T chord = ChordForce(load, t) / load.l;
  Vector2<T> force{-chord * load.u, chord * load.y};
  if (is_driven_) {
    const T normal = torque / (load.l * load.l);
    force = {normal * load.y - chord * load.u, chord * load.y + torque_lift_ * normal * load.u};
  }
  if (damps_along_arc_) {  // the part along the chord is in it
    const T across = (load.y * load.viscous_x + load.u * load.viscous_y) / (load.l * load.l);
    force.x += across * load.y;
    force.y += across * load.u;
  }
  return force;
}

}  // namespace hoplab
