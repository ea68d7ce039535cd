#pragma once

#include "fitting/driven_trial.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {

/// When a trial's `contact` column was read, in the simulation's time [s]: as other channels, by
/// its clock and by the effects that shift the time of observation (clock_scale, sensor_delay).
class ContactReading {
 public:
  ContactReading(const FitProblem& problem, const TrialProblem& trial,
                 const EvaluationRequest& request);

  double Time(double stamp) const;
  /// The derivative of that time.
  double Slope(double stamp, const SensitivityDirection& by) const;

 private:
  int clock_;
  TrialRequest trial_;
};

}  // namespace hoplab
