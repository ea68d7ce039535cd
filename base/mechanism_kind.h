#pragma once

#include <array>

namespace hoplab {

// What a hopper is, in the words of the file; the data format and the simulator share them.

enum class MechanismKind { kCLeg, kStraightLeg, kBall, kRobot };
inline constexpr std::array kMechanisms = {MechanismKind::kCLeg, MechanismKind::kStraightLeg,
                                           MechanismKind::kBall, MechanismKind::kRobot};
/// "c_leg", "straight_leg", "ball", "robot".
const char* NameOf(MechanismKind kind);

/// When a leg leaves the ground: at zero chord force, or when it is back at its rest length.
enum class LiftoffRule { kZeroForce, kRestLength };
/// "zero_force", "rest_length".
const char* NameOf(LiftoffRule rule);

/// What the motors of a robot follow: an angle each, locked or held by its controller, a clock, or
/// what was recorded of each: its torque or its reference.
enum class MotorControl { kLocked, kHeld, kClock, kRecorded };
/// "locked", "held", "clock", "recorded".
const char* NameOf(MotorControl control);

}  // namespace hoplab
