#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "optimize/hopper.h"

namespace hoplab {

/// A column a sweep can compute.
struct SweepOutput {
  std::string_view name;
  std::string_view unit;
  /// What it costs beside the run itself.
  bool needs_stance_samples = false;  // leg angle and length every millisecond
  bool needs_fixed_point = false;
};

/// Every output there is.
const std::vector<SweepOutput>& AllSweepOutputs();
/// Throws InputError with the nearest known name.
const SweepOutput& ResolveSweepOutput(const std::string& name, const std::string& place);

/// What one run gave: values in the order asked for, NaN where one does not exist, and how it
/// ended.
struct SweepRow {
  std::vector<double> values;
  std::string outcome;  // name of an Outcome, or "bad_input"
  std::string reason;   // one sentence; empty for a run that reached its end
  bool operator==(const SweepRow&) const = default;
};

/// Runs the hopper and computes the outputs. A run that ends early keeps what is still true of it
/// (its end, its hops, how stiff the leg was); the rest is NaN.
SweepRow ComputeSweepRow(const Hopper& hopper, const std::vector<const SweepOutput*>& outputs);

}  // namespace hoplab
