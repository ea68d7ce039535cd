#pragma once

#include "experiments/identification/controlled_run.h"
#include "optimize/apex_map.h"
#include "optimize/fixed_point.h"

namespace hoplab {

/// The steady hop of a massless controlled hopper, and how its neighbours come back: what decides
/// the stiffness ranges and the slow convergence times at a fraction of the cost of the runs.
struct SteadyHop {
  FixedPoint point;     // where `point.stable()` is false nothing else means anything
  ControlledRun start;  // its run from the common start: the first hops of it, if it gets that far
};

/// Searched from where some hops from the common start lead.
SteadyHop FindSteadyHop(const StudyHopper& hopper, double modulus_Pa, double damping_N_s_per_m);

/// The run of RunControlled as the steady hop predicts it: its first three hops simulated, the
/// others by the linear map of `point`. `stiffness` of `wants` is that of the steady hop; instants
/// there are none.
ControlledRun PredictControlled(const StudyHopper& hopper, const ControlledSettings& settings,
                                const FixedPoint& point, const RunWants& wants = {});

}  // namespace hoplab
