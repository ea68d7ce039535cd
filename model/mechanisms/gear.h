#pragma once

#include "model/jet.h"
#include "model/robot_parameters.h"

namespace hoplab {

/// The gear between a motor and its hip where it has play (M96). The twist is how far the rotor is
/// ahead of the hip [rad], both counted at the hip.
template <class T>
struct Gear {
  T half{0.0};       // of the play [rad]
  T stiffness{0.0};  // of the teeth, 2 tau_t/play [N m/rad]
  T damping{0.0};    // c_t [s/rad]

  /// Less play than this [rad] is none: the rotor turns with its hip.
  static constexpr double kLeastPlay = 2e-4;

  static bool HasPlay(const RobotParameters<T>& robot, int motor) {
    return Value(robot.play[static_cast<std::size_t>(motor)]) >= kLeastPlay;
  }

  Gear() = default;
  Gear(const RobotParameters<T>& robot, int motor) {
    const auto i = static_cast<std::size_t>(motor);
    half = 0.5 * robot.play[i];
    stiffness = robot.tooth_torque[i] / half;
    damping = robot.tooth_damping[i];
  }

  /// How deep the teeth on a side (+1: the rotor drives its angle up, -1: down) are pressed, of
  /// teeth that are apart less than 0 [rad].
  T Press(double side, const T& twist) const { return side * twist - half; }
  /// What the teeth on that side put on the hip, and take from the rotor [N m]; 0 on side 0.
  T Torque(double side, const T& twist, const T& rate) const {
    if (side == 0.0) return T(0.0);
    return side * stiffness * Press(side, twist) * (1.0 + damping * side * rate);
  }
  /// Strain energy of the teeth [J].
  T Energy(double side, const T& twist) const {
    if (side == 0.0) return T(0.0);
    const T press = Press(side, twist);
    return 0.5 * stiffness * press * press;
  }
};

}  // namespace hoplab
