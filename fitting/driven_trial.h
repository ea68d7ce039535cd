#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

// What a log brings along as a fit sees it: columns that drive a trial, its own touch-down angles,
// a start in stance, clocks of sensors; which of their values are fitted, shared or one trial's
// own.

/// The clocks of a dataset, as FitProblem::clocks has them.
std::vector<ClockProblem> ClocksOf(const Dataset& dataset);

/// Fills in what drives `t`, and appends its own values: each touch-down's angle where they are not
/// known exactly, the offset of each clock that differs between trials.
void AddDriven(const Trial& trial, const FitProblem& problem, TrialProblem& t);

/// The shared value of that name, "input.hip_torque.delay", "clock.motor.offset"; nothing for a
/// name of another kind. Throws InputError (place `place`) for an input or clock that is not there.
std::optional<SharedParameter> DrivenParameter(const FitProblem& problem, const std::string& name,
                                               const std::string& place);

/// Frees what the dataset says is known within a sigma only, each with its prior; what `fixed`
/// names is left as it is.
void FreeWhatIsUncertain(const Dataset& dataset, const std::map<std::string, double>& fixed,
                         FitProblem& problem);

/// Holds a delay, scale or offset at a value (--fix); false for a name of another kind.
bool FixDriven(const std::string& name, double value, FitProblem& problem);

/// A simulation of a trial as a request, and what it points into.
struct TrialRequest {
  SimulationRequest request;
  std::vector<EffectSetting> effects;
  std::vector<DrivenInput> inputs;
  std::vector<double> touchdown_angles, clock_offsets;
  std::vector<int> channel_clocks;
};

/// Fills `out` with a trial at these values: law, parameters, effects, start and what drives it;
/// rows, channels and horizon are the caller's.
void FillTrialRequest(const FitProblem& problem, const TrialProblem& trial,
                      const Eigen::Ref<const Eigen::VectorXd>& shared,
                      const Eigen::Ref<const OwnValues>& own, TrialRequest& out);

/// By how much the clocks may at most shift a reading into the future [s].
double LatestClock(const FitProblem& problem, const TrialProblem& trial);

/// Leaves of what drives `trial` what its piece from `origin` (s since its first row) up to `end`
/// needs, `first` telling whether the piece begins the trial.
void CutDriven(TrialProblem& trial, double origin, double end, bool first);

}  // namespace hoplab
