#pragma once

#include <vector>

#include "model/effects/active_effects.h"
#include "model/inputs.h"
#include "model/parameters.h"

namespace hoplab {

/// What a mechanism is made of.
template <class T>
struct MechanismSetup {
  Law law = Law::kElastica;
  Parameters<T> parameters;  // as the effects left them
  ActiveEffects<T> effects;
  LiftoffRule liftoff = LiftoffRule::kZeroForce;
  InputSignals<T> inputs = {};
  /// Commanded leg angle of each touch-down, the last one's for later ones [rad]; empty:
  /// parameters.theta_td for all.
  std::vector<T> touchdown_angles = {};
};

}  // namespace hoplab
