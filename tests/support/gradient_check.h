#pragma once

#include <string>
#include <vector>

#include "model/simulate.h"

namespace hoplab::testing {

/// One derivative column held against Richardson differences of whole runs.
struct ColumnCheck {
  std::string what;               // "samples d/dE"
  double error = 0.0;             // |analytic - differences| over the column's norm
  double oracle_error = 0.0;      // what the differences themselves may be off by, over the same
  bool nothing_to_see = false;    // both sides are zero against the size of the values
  bool sequence_changed = false;  // the differences straddle another event sequence
};

/// Every requested direction of `request`: samples (if rows are asked for), final state and event
/// times, each column by itself. Runs without directions are the oracle.
std::vector<ColumnCheck> CheckGradient(const SimulationRequest& request);

/// The same with given analytic derivatives in place of those of the run: to show the check fails.
std::vector<ColumnCheck> CheckGradient(const SimulationRequest& request,
                                       const Trajectory& analytic);

/// What is wrong with a check; empty if it passed.
std::string Complaint(const ColumnCheck& check);

/// Name of a direction.
std::string NameOf(const SimulationRequest& request, const SensitivityDirection& direction);

}  // namespace hoplab::testing
