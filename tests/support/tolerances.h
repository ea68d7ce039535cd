#pragma once

#include <limits>

namespace hoplab::testing {

// Every tolerance the tests use, with where it comes from. None is to be loosened to go green.

inline constexpr double kEps = std::numeric_limits<double>::epsilon();

/// A closed form evaluated in double against the same in more digits: a hundred roundings.
inline constexpr double kClosedForm = 1e-12;

/// Closed-form flight over ten bounces: each bounce multiplies the relative rounding error of the
/// remaining interval by 1/restitution (1/0.8^10 = 9), a few hundred roundings in all.
inline constexpr double kTenBounces = 1e-10;

/// Solver tolerance of runs that serve as (or are held against) an oracle.
inline constexpr double kOracleRelative = 1e-13;
inline constexpr double kOracleAbsolute = 1e-14;

/// Derivative columns against Richardson differences, relative to the column's norm. The
/// differences themselves reach 1e-7 of it (asserted): runs at 1e-13 divided by steps of about
/// 1e-2, and two extrapolations.
inline constexpr double kGradient = 1e-6;
inline constexpr double kGradientOracle = 3e-7;

/// Energy drift of an undamped hop at solver tolerances 1e-12: about a dozen steps, each within
/// tolerance of the state, magnified by the force's slope k/(m omega) ~ 50.
inline constexpr double kEnergyDrift = 1e-9;

/// A located guard in units of its scale: the event time is polished to rounding of the state.
inline constexpr double kEventResidual = 1e-12;

/// Residuals of M9 and M10 at a solved state, in units of r and of 1: rounding of C F/r.
inline constexpr double kLawResidual = 1e-12;

}  // namespace hoplab::testing
