#pragma once

#include <string>
#include <vector>

#include "model/simulate.h"

namespace hoplab {

/// A direction `--sensitivities` names: x0, y0, vx0, vy0, a parameter of the mechanism of a run or
/// effect.parameter of an effect that acts. Throws InputError of `option` with the nearest known
/// name.
SensitivityDirection ResolveDirection(const std::string& name, const SimulationRequest& of,
                                      LegMass mass, const std::vector<EffectSetting>& effects,
                                      const char* option = "--sensitivities");

}  // namespace hoplab
