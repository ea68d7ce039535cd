#pragma once

#include <numbers>

namespace hoplab {

/// Angle [deg] to [rad]. Degrees occur only at the border: files, options, reports.
constexpr double DegToRad(double angle_deg) { return angle_deg * (std::numbers::pi / 180.0); }

/// Angle [rad] to [deg].
constexpr double RadToDeg(double angle_rad) { return angle_rad * (180.0 / std::numbers::pi); }

}  // namespace hoplab
