#pragma once

#include "model/parameters.h"

namespace hoplab {

/// What sets a mechanism apart where fits and searches treat it in its own way: one row a
/// mechanism.
struct MechanismTraits {
  bool has_stance;      // it rolls or stands on the ground; else it bounces
  bool has_placed_leg;  // one leg, which lands at an angle that a request tells
  bool has_pitch;       // a start has pitch and its rate, which no trace tells
  /// Legs land one after the other: no apex of a trace tells a state to shoot from.
  bool lands_leg_by_leg;
  /// A run costs so much that what a solve does not need of it is left out.
  bool has_costly_runs;
  /// Height of the body or hip at touch-down [m]; null where legs land one after the other.
  double (*touchdown_height)(const Parameters<double>& p);
};
const MechanismTraits& TraitsOf(MechanismKind mechanism);
inline const MechanismTraits& TraitsOf(Law law) { return TraitsOf(MechanismOf(law)); }

}  // namespace hoplab
