#pragma once

#include <array>
#include <limits>
#include <memory>
#include <utility>

#include "base/mechanism_kind.h"
#include "model/jet.h"

namespace hoplab {

/// Most legs of a robot, seen from the side.
inline constexpr int kMaxLegs = 4;

/// A robot's body, motors and legs (section 8 of the equation sheet), beside the mass and gravity
/// it has with every mechanism. SI units and radians; angles as in section 8.
template <class T>
struct RobotParameters {
  int legs = 2;
  T pitch_inertia{1.0};      // about the centre of mass [kg m^2]
  T com_x{0.0}, com_y{0.0};  // centre of mass in the body frame [m]
  T rotor_inertia{0.0};      // of each motor, reflected to the hip, on the relative speed [kg m^2]
  T motor_kp{0.0};           // [N m/rad]
  T motor_kd{0.0};           // [N m s/rad]
  T torque_limit{std::numeric_limits<double>::infinity()};  // of a motor [N m]
  T motor_gain{1.0};  // what a motor gives of what it is told [-]
  T motor_lag{0.0};   // how long what it gives follows what it is told [s]
  T friction{std::numeric_limits<double>::infinity()};  // under the feet [-]
  T foot_slip{0.0};          // how fast feet that hold creep under a force along [m/(N s)]
  T ground_compliance{0.0};  // how far the ground sinks under a foot (M28) [m/N]
  T clamp{0.0};              // length of every leg that its hub holds rigid [m]
  T damping{0.0};            // retardation time of every leg's material [s]
  T leg_mass{0.0};           // of every leg, beside the body's [kg]
  T stiffness_drift{0.0};    // of every leg, gamma_E [1/s]
  T lateral_stiffness{1.0};  // of straight legs, across [N/m]; k and l0 are those of Parameters
  std::array<T, kMaxLegs> E{T(1.0), T(1.0), T(1.0), T(1.0)};      // [Pa]
  std::array<T, kMaxLegs> hip_x{T(0.0), T(0.0), T(0.0), T(0.0)};  // in the body frame [m]
  std::array<T, kMaxLegs> hip_y{T(0.0), T(0.0), T(0.0), T(0.0)};
  // Held or locked at; of recorded motors where they begin, and how fast [rad], [rad/s].
  std::array<T, kMaxLegs> angle{T(0.0), T(0.0), T(0.0), T(0.0)};
  std::array<T, kMaxLegs> rate{T(0.0), T(0.0), T(0.0), T(0.0)};
  // What sets one leg or motor apart from the others; effects alone change these.
  std::array<T, kMaxLegs> E_scale{T(1.0), T(1.0), T(1.0), T(1.0)};        // [-]
  std::array<T, kMaxLegs> extra_damping{T(0.0), T(0.0), T(0.0), T(0.0)};  // beside damping [s]
  std::array<T, kMaxLegs> gain_of{T(1.0), T(1.0), T(1.0), T(1.0)};        // beside motor_gain [-]
  std::array<T, kMaxLegs> leg_zero{T(0.0), T(0.0), T(0.0), T(0.0)};       // M100 [rad]
  std::array<T, kMaxLegs> torque_bias{T(0.0), T(0.0), T(0.0), T(0.0)};    // M101 [N m]
  // Friction of the hips (M99).
  std::array<T, kMaxLegs> hip_viscous{T(0.0), T(0.0), T(0.0), T(0.0)};  // [N m s/rad]
  std::array<T, kMaxLegs> hip_coulomb{T(0.0), T(0.0), T(0.0), T(0.0)};  // [N m]
  // Gears (M96); no play, no gear.
  std::array<T, kMaxLegs> play{T(0.0), T(0.0), T(0.0), T(0.0)};  // from tooth to tooth [rad]
  std::array<T, kMaxLegs> tooth_torque{T(1.0), T(1.0), T(1.0), T(1.0)};   // tau_t [N m]
  std::array<T, kMaxLegs> tooth_damping{T(0.0), T(0.0), T(0.0), T(0.0)};  // c_t [s/rad]
  std::array<T, kMaxLegs> hub_share{T(0.0), T(0.0), T(0.0), T(0.0)};  // s_h, of rotor_inertia [-]
  // Clock (M76).
  T period{1.0};                                                  // [s]
  T duty{0.5};                                                    // [-]
  T sweep{1.0};                                                   // [rad]
  T offset{0.0};                                                  // [rad]
  std::array<T, kMaxLegs> phase{T(0.0), T(0.0), T(0.0), T(0.0)};  // [-]
  // Settings without derivatives.
  bool straight_legs = false;  // M97; else half circles
  bool own_moduli = false;     // each leg has its E; else all have that of Parameters
  MotorControl control = MotorControl::kHeld;
  bool starts_at_angles = false;  // recorded motors, at `angle`; else on what they follow
  /// What a start has beside pitch and its rate is how far feet and motors are ahead (M119).
  bool starts_leaning = false;
  double pitch_limit = 1.4;  // [rad]

  /// Every differentiable number, in one order: for converting.
  template <class Self, class Do>
  static void Each(Self& p, const Do& act) {
    for (auto* v : {&p.pitch_inertia,  &p.com_x,    &p.com_y,        &p.rotor_inertia,
                    &p.motor_kp,       &p.motor_kd, &p.torque_limit, &p.motor_gain,
                    &p.motor_lag,      &p.friction, &p.foot_slip,    &p.ground_compliance,
                    &p.clamp,          &p.damping,  &p.leg_mass,     &p.lateral_stiffness,
                    &p.period,         &p.duty,     &p.sweep,        &p.offset,
                    &p.stiffness_drift})
      act(*v);
    for (auto* list : {&p.E, &p.hip_x, &p.hip_y, &p.angle, &p.rate, &p.E_scale, &p.extra_damping,
                       &p.gain_of, &p.leg_zero, &p.torque_bias, &p.hip_viscous, &p.hip_coulomb,
                       &p.play, &p.tooth_torque, &p.tooth_damping, &p.hub_share, &p.phase})
      for (auto& v : *list) act(v);
  }
};

/// The same in another scalar type; directions are dropped.
template <class To, class From>
RobotParameters<To> ConvertRobot(const RobotParameters<From>& from) {
  RobotParameters<To> to;
  std::array<double, 21 + 17 * kMaxLegs> values{};
  std::size_t n = 0;
  RobotParameters<From>::Each(from, [&](const From& v) { values[n++] = Value(v); });
  n = 0;
  RobotParameters<To>::Each(to, [&](To& v) { v = To(values[n++]); });
  to.legs = from.legs;
  to.straight_legs = from.straight_legs;
  to.own_moduli = from.own_moduli;
  to.control = from.control;
  to.starts_at_angles = from.starts_at_angles;
  to.starts_leaning = from.starts_leaning;
  to.pitch_limit = from.pitch_limit;
  return to;
}

/// A robot's parameters, or none: copied with what holds it. A hopper's parameters hold none and
/// stay as small as they are.
template <class T>
class MaybeRobot {
 public:
  MaybeRobot() = default;
  ~MaybeRobot() = default;
  MaybeRobot(const MaybeRobot& other)
      : held_(other.held_ ? std::make_unique<RobotParameters<T>>(*other.held_) : nullptr) {}
  MaybeRobot(MaybeRobot&&) noexcept = default;
  MaybeRobot& operator=(const MaybeRobot& other) {
    if (this != &other) *this = MaybeRobot(other);
    return *this;
  }
  MaybeRobot& operator=(MaybeRobot&&) noexcept = default;
  MaybeRobot& operator=(RobotParameters<T> robot) {
    held_ = std::make_unique<RobotParameters<T>>(std::move(robot));
    return *this;
  }

  explicit operator bool() const { return held_ != nullptr; }
  RobotParameters<T>& operator*() { return *held_; }
  const RobotParameters<T>& operator*() const { return *held_; }
  RobotParameters<T>* operator->() { return held_.get(); }
  const RobotParameters<T>* operator->() const { return held_.get(); }

 private:
  std::unique_ptr<RobotParameters<T>> held_;
};

}  // namespace hoplab
