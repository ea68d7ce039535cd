#pragma once

#include <span>
#include <string>

#include "model/simulate.h"

namespace hoplab {

/// What ended a run, said of the simulation as SentenceOf says it. Of one that could not go on
/// while formulas act it names the formula that is no number there, and where that is; else those
/// it may be. `initial` is what the run began with, x, y, vx, vy first; may be empty.
std::string WhyEnded(const Trajectory& run, std::span<const EffectSetting> effects,
                     std::span<const double> initial = {});

}  // namespace hoplab
