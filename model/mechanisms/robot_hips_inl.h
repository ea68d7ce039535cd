#pragma once

#include <cmath>

#include "model/mechanisms/robot_motion_inl.h"

// Friction of a robot's hips: viscous, and dry, which holds a hip that does not turn (M99).

namespace hoplab {

namespace robot_detail {
// Less dry friction than this holds nothing: it has a derivative alone [N m].
inline constexpr double kLeastHipFriction = 1e-6;
// That derivative turns round within this rate [rad/s].
inline constexpr double kNullFrictionWidth = 0.05;
}  // namespace robot_detail

// Whether dry friction of the hip can hold it; less than the least has a derivative alone.
template <class T>
bool Robot<T>::IsDry(int leg) const {
  return rubs_[leg] && Value(robot_.hip_coulomb[leg]) >= robot_detail::kLeastHipFriction;
}

// What the friction of a hip that is not held takes from its motor [N m].
template <class T>
T Robot<T>::HipFriction(int leg, const T* z) const {
  using std::tanh;
  const T& rate = z[Rate(leg)];
  const T& dry = robot_.hip_coulomb[leg];
  return robot_.hip_viscous[leg] * rate +
         (IsDry(leg) ? T(leg_[leg].turns_by * dry)
                     : T(dry * tanh(rate / robot_detail::kNullFrictionWidth)));
}

// Before an instant that may turn a hip: friction bears no blow.
template <class T>
void Robot<T>::LetHipsGo() {
  for (int i = 0; i < legs_; ++i) leg_[i].is_held = false;
}

// Which hips turn which way, where rates have jumped.
template <class T>
void Robot<T>::FindTurns(const T* z) {
  for (int i = 0; i < legs_; ++i) {
    if (!IsDry(i)) continue;
    const double rate = Value(z[Rate(i)]);
    leg_[i].turns_by = rate == 0.0 ? 0.0 : rate > 0.0 ? 1.0 : -1.0;
  }
}

// Hips that do not turn are held, but where that asks for more than friction gives: of those the
// one that asks for most is let go, until none is left. What would turn one that is held stops at
// once.
template <class T>
void Robot<T>::SettleHips(const T& t, T* z) {
  if (!has_dry_hips_) return;
  FindTurns(z);
  for (int i = 0; i < legs_; ++i) leg_[i].is_held = IsDry(i) && leg_[i].turns_by == 0.0;
  const Frame frame(z[Pitch()] - p_.slope);
  while (HoldsHip()) {
    const std::array<T, kMaxLegs> holding = ForcesOf(frame, t, z).holding;
    int first = -1;
    double most = 1.0;
    for (int i = 0; i < legs_; ++i) {
      const double share = std::abs(Value(holding[i]) / Value(robot_.hip_coulomb[i]));
      if (!leg_[i].is_held || !(share > most)) continue;
      most = share;
      first = i;
    }
    if (first < 0) break;
    TurnHip(first, holding[first]);
  }
  for (int i = 0; i < legs_; ++i)
    if (leg_[i].is_held) z[Rate(i)] = T(0.0);
}

template <class T>
bool Robot<T>::HoldsHip() const {
  for (int i = 0; i < legs_; ++i)
    if (leg_[i].is_held) return true;
  return false;
}

// The hip begins to turn the way it is driven.
template <class T>
void Robot<T>::TurnHip(int leg, const T& holding) {
  leg_[leg].is_held = false;
  leg_[leg].turns_by = Value(holding) > 0.0 ? 1.0 : -1.0;
}

// Below zero where the hip stops, or, once it is held, where friction does not hold it.
template <class T>
T Robot<T>::HipMargin(int leg, const T& holding, const T* z) const {
  if (!leg_[leg].is_held) return leg_[leg].turns_by * z[Rate(leg)];
  return robot_.hip_coulomb[leg] - (Value(holding) < 0.0 ? T(-holding) : holding);
}

}  // namespace hoplab
