#pragma once

#include <string>
#include <string_view>

#include "tests/support/beam_rig.h"

namespace hoplab::testing {

inline constexpr double kBeamGravity = 9.81;         // m/s^2
inline constexpr double kBeamRow = 2e-3;             // of what is recorded [s]
inline constexpr double kBeamHingeInertia = 1.6e-6;  // that each hinge adds [kg m^2]

/// The leg of `rig` in MuJoCo's language: a chain of arcs from the hip `hip`, at the origin, whose
/// rotor adds `rotor_inertia` [kg m^2].
std::string BeamLegText(const BeamRig& rig, std::string_view hip, double rotor_inertia);

/// The load of `extras` on a body whose text this is part of; its joint is `load`. Empty: none.
std::string BeamLoadText(const BeamExtras& extras);

/// A model with the floor of `rig` and one body on it: `body` its joints, inertia and legs,
/// `actuators` its motors, `tendons` what couples its joints.
std::string BeamWorldText(const BeamRig& rig, std::string_view body, std::string_view actuators,
                          std::string_view tendons = "");

}  // namespace hoplab::testing
