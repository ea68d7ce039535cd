#pragma once

#include "base/range.h"

/// What the numbers of a mechanism, its controller and its clock must lie in, wherever they are
/// stated: in a dataset, in a scenario or on the command line.
namespace hoplab::stated {

inline constexpr Range kMass = Positive(1e6, "kg");
inline constexpr Range kGravity = Positive(1e3, "m/s^2");
inline constexpr Range kLength = Positive(100, "m");
inline constexpr Range kPlace = Within(100, "m");
// Legs.
inline constexpr Range kModulus = Positive(1e13, "Pa");
inline constexpr Range kSecondMoment = Positive(1e3, "m^4");
inline constexpr Range kArea = Positive(100, "m^2");
inline constexpr Range kShearFactor = Positive(10, "");
inline constexpr Range kStiffness = Positive(1e9, "N/m");
inline constexpr Range kDamping = NonNegative(1e6, "N s/m");
inline constexpr Range kToeMass = NonNegative(1e6, "kg");
inline constexpr Range kMotorKp = NonNegative(1e6, "N m/rad");
inline constexpr Range kMotorKd = NonNegative(1e6, "N m s/rad");
// Balls.
inline constexpr Range kFraction = NonNegative(1, "");
inline constexpr Range kDensity = NonNegative(1e4, "kg/m^3");
// The speed controller.
inline constexpr Range kSpeedGain = NonNegative(1e6, "N s");
inline constexpr Range kSpeed = Within(1e3, "m/s");
// Robots.
inline constexpr Range kPitchInertia = Positive(1e6, "kg m^2");
inline constexpr Range kFriction = NonNegative(1e3, "");
inline constexpr Range kRotorInertia = Positive(1e3, "kg m^2");
inline constexpr Range kMaterialDamping = NonNegative(0.1, "s");
inline constexpr Range kLegMass = NonNegative(1e3, "kg");
/// Of a half circle of that radius.
constexpr Range Clamp(double rest_radius) { return NonNegative(2 * rest_radius, "m"); }
// A robot's clock.
inline constexpr Range kPeriod = Positive(1e3, "s");
inline constexpr Range kDuty = {0, 1, false, false, ""};
inline constexpr Range kSweep = {0, 6.2831853, false, false, "rad"};
inline constexpr Range kAngle = Within(1e3, "rad");
inline constexpr Range kPhase = Within(1e3, "");

}  // namespace hoplab::stated
