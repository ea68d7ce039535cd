#pragma once

#include <vector>

#include "model/simulate.h"

namespace hoplab {

/// A hopper to look at from several sides: a simulation with its own copy of its effects, so that
/// it can be copied and changed. `request.effects`, rows and directions are not used.
struct Hopper {
  SimulationRequest request;
  std::vector<EffectSetting> effects;
};

/// The hopper's request with its effects in place; it points into `hopper`.
SimulationRequest RequestOf(const Hopper& hopper);

/// The value a direction stands for: a parameter, an effect's parameter or a component of the
/// start; SI.
double ValueOf(const Hopper& hopper, const SensitivityDirection& direction);
void SetValue(Hopper& hopper, const SensitivityDirection& direction, double value);

/// A size against which steps of that value are small: its own size, or a usual one where it is 0.
double ScaleOf(const Hopper& hopper, const SensitivityDirection& direction);

}  // namespace hoplab
