#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "optimize/continuation.h"
#include "optimize/convergence_time.h"
#include "optimize/stride_measures.h"

namespace hoplab {

/// A parameter to follow the fixed point along, and between which values [SI].
struct AlongRange {
  std::string name;
  double low = 0.0, high = 0.0;
};

/// `name=low:high`; throws UsageError for anything else.
AlongRange ParseAlong(const std::string& text);

/// What `hoplab gait` computes: of a hopper its steady hop, of a robot with a clock its steady
/// stride.
struct GaitRun {
  Hopper hopper;
  std::shared_ptr<ReturnMap> map;            // absent: a robot that fell too soon to have one
  std::vector<SectionComponent> components;  // of `start` and the fixed point
  SectionState start;
  FixedPoint point;
  Outcome own_outcome = Outcome::kCompleted;  // of a robot's run from its own start
  double own_strides = 0.0;                   // that it made
  std::optional<StrideMeasures> stride;       // of a robot's steady stride
  HopPrediction prediction;
  std::vector<std::string> parameters;  // names of what the spectral radius is differentiated by
  std::vector<SpectralRadiusRate> rates;
  std::vector<char> computed;              // one a rate: an interruption leaves some out
  std::optional<ConvergenceTime> counted;  // in the scenario's own run, where it runs to its end
  std::vector<ApexSpeed> apexes;           // of that run
  std::optional<AlongRange> along;
  Branch branch;
  bool interrupted = false;

  /// Why there is no usable result; empty if there is one.
  std::string Failure() const;
};

struct GaitOptions {
  std::optional<AlongRange> along;
  std::function<void(const std::string& stage)> stage = nullptr;
  const std::atomic<bool>* stop = nullptr;
  int jobs = 1;  // never changes a result
};

/// Throws InputError if `along` names nothing this hopper has.
GaitRun RunGait(const Hopper& hopper, const GaitOptions& options);

/// What a name after --along, or of a rate, stands for. Throws InputError for none the hopper has.
SensitivityDirection GaitDirection(const Hopper& hopper, const std::string& name);

}  // namespace hoplab
