#pragma once

#include <numbers>

namespace hoplab {

inline constexpr double kPi = std::numbers::pi;

/// Angle [deg] to [rad]. Degrees occur only at the border: files, options, reports.
constexpr double DegToRad(double angle_deg) { return angle_deg * (kPi / 180.0); }

/// Angle [rad] to [deg].
constexpr double RadToDeg(double angle_rad) { return angle_rad * (180.0 / kPi); }

}  // namespace hoplab
