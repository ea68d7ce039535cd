#pragma once

#include <boost/container/static_vector.hpp>

#include "base/check.h"
#include "model/effects/effect.h"

namespace hoplab {

/// The effects that act in one run, in the scalar type of the run. Only effects off their null, or
/// whose parameter is differentiated, are in it: the others cost nothing and change nothing. They
/// act in ascending EffectInfo::order, those of one order as they were added.
template <class T>
class ActiveEffects {
 public:
  static constexpr int kMax = 48;

  void Add(const Effect& effect, const std::array<T, kMaxEffectParameters>& values) {
    HOPLAB_CHECK(entries_.size() < kMax);
    auto place = entries_.end();
    while (place != entries_.begin() && (place - 1)->effect->info.order > effect.info.order)
      --place;
    entries_.insert(place, {&effect.Hooks<T>(), values, &effect});
  }

  /// The same effects in another scalar type; directions are dropped.
  template <class To>
  ActiveEffects<To> Convert() const {
    ActiveEffects<To> to;
    for (const Entry& e : entries_) {
      std::array<To, kMaxEffectParameters> values;
      for (int i = 0; i < kMaxEffectParameters; ++i) values[i] = To(Value(e.values[i]));
      to.Add(*e.effect, values);
    }
    return to;
  }

  void ChangeParameters(Parameters<T>& parameters) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_parameters) e.hooks->change_parameters(e.values.data(), parameters);
    }
  }
  Vector2<T> BodyForce(const BodyMotion<T>& body) const {
    Vector2<T> force{T(0.0), T(0.0)};
    for (const Entry& e : entries_) {
      if (e.hooks->add_body_force) e.hooks->add_body_force(e.values.data(), body, force);
    }
    return force;
  }
  T ChordForce(const ChordMotion<T>& chord) const {
    T force(0.0);
    for (const Entry& e : entries_) {
      if (e.hooks->add_chord_force) e.hooks->add_chord_force(e.values.data(), chord, force);
    }
    return force;
  }
  void AddHipTorque(const HipMotion<T>& hip, T& torque) const {
    for (const Entry& e : entries_) {
      if (e.hooks->add_hip_torque) e.hooks->add_hip_torque(e.values.data(), hip, torque);
    }
  }
  T JointTorque(const JointMotion<T>& joint) const {
    T torque(0.0);
    for (const Entry& e : entries_) {
      if (e.hooks->add_joint_torque) e.hooks->add_joint_torque(e.values.data(), joint, torque);
    }
    return torque;
  }
  void ChangeLandingVelocity(const Landing<T>& landing, Vector2<T>& velocity) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_landing_velocity)
        e.hooks->change_landing_velocity(e.values.data(), landing, velocity);
    }
  }
  void ChangeLiftoffVelocity(const Landing<T>& leaving, Vector2<T>& velocity) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_liftoff_velocity)
        e.hooks->change_liftoff_velocity(e.values.data(), leaving, velocity);
    }
  }
  T ContactHeight(T height) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_contact_height) e.hooks->change_contact_height(e.values.data(), height);
    }
    return height;
  }
  T Restitution(const T& speed, T restitution) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_restitution)
        e.hooks->change_restitution(e.values.data(), speed, restitution);
    }
    return restitution;
  }
  T TouchdownAngle(const T& vx, T theta_td) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_touchdown_angle)
        e.hooks->change_touchdown_angle(e.values.data(), vx, theta_td);
    }
    return theta_td;
  }
  T ObservationTime(T t) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_observation_time) e.hooks->change_observation_time(e.values.data(), t);
    }
    return t;
  }
  void ChangeObservation(Observation<T>& seen) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_observation) e.hooks->change_observation(e.values.data(), seen);
    }
  }
  /// What is there at all, so that what is not costs nothing.
  bool HasBodyForce() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.add_body_force != nullptr; });
  }
  bool HasChordForce() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.add_chord_force != nullptr; });
  }
  bool HasHipTorque() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.add_hip_torque != nullptr; });
  }
  bool HasJointTorque() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.add_joint_torque != nullptr; });
  }
  bool HasLiftoffVelocity() const {
    return Any(
        [](const EffectHooks<T>& hooks) { return hooks.change_liftoff_velocity != nullptr; });
  }
  bool HasTouchdownAngle() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.change_touchdown_angle != nullptr; });
  }

 private:
  template <class Predicate>
  bool Any(const Predicate& holds) const {
    for (const Entry& e : entries_) {
      if (holds(*e.hooks)) return true;
    }
    return false;
  }

  struct Entry {
    const EffectHooks<T>* hooks;
    std::array<T, kMaxEffectParameters> values;
    const Effect* effect;
  };
  boost::container::static_vector<Entry, kMax> entries_;
};

}  // namespace hoplab
