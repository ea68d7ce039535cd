#pragma once

#include "datasets/scenario.h"
#include "optimize/apex_map.h"

namespace hoplab {

/// The scenario's run as a hopper: law, parameters, effects, start, horizon. A scenario that does
/// not say when it stops runs for 60 s. Throws InputError for laws and effects that do not exist.
Hopper HopperOfScenario(const Scenario& scenario, const IntegratorOptions& integrator);

/// The same for a hopper on legs or a robot with a clock; throws InputError for what has no gait.
Hopper LeggedHopperOfScenario(const Scenario& scenario, const IntegratorOptions& integrator);

/// The apex of the flight that the run starts in (before or after its start), without drag.
ApexState StartApex(const Hopper& hopper);

}  // namespace hoplab
