#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fitting/diagnosis/fitted_model.h"
#include "fitting/trial_errors.h"

namespace hoplab {

/// Errors of quantities an engineer would look at, over the held-out trials.
struct FeatureErrors {
  double apex_height_rmse = 0.0;                             // m; NaN where no apexes show
  double apex_time_rmse = 0.0;                               // s; likewise
  double touchdown_time_rmse = 0.0, stance_time_rmse = 0.0;  // s; NaN without a contact channel
};

/// One model on the held-out trials, the start of each refitted under its prior.
struct HeldOutErrors {
  std::vector<TrialErrors> trials;  // of all roles, the order of the problem
  RoleErrors test;
  FeatureErrors features;
};

/// Log-likelihood gained a sample on trials that were not fitted [nats], each model under its own
/// noise, paired block by block.
struct HeldOutGain {
  double nats_per_sample = 0.0;                   // NaN if there is nothing to compare
  std::optional<std::pair<double, double>> ci95;  // bootstrap over blocks; absent with fewer than 4
  long samples = 0;
  int hops = 0;
  int blocks = 0;
  /// Whether the gain may be claimed: the whole interval lies above zero.
  bool IsClaim() const { return ci95 && ci95->first > 0.0; }
};

/// With `test_only` the errors of train trials are left out. `like`: of another model of
/// these trials (AssessTrials).
HeldOutErrors MeasureHeldOut(const FittedModel& model, int jobs, bool test_only = false,
                             const HeldOutErrors* like = nullptr);

/// Gain of `after` over `before`; trials one of the two cannot simulate to their end are left out
/// and named in `left_out`. Rows are whitened, so blocks may be shorter than a hop: as long as the
/// time over which the errors of `before` hang together, and no longer than a hop.
HeldOutGain CompareHeldOut(const FittedModel& before, const HeldOutErrors& errors_before,
                           const HeldOutErrors& errors_after, std::uint64_t seed,
                           std::vector<std::string>* left_out);

}  // namespace hoplab
