#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/fit.h"
#include "fitting/gradient_certificate.h"
#include "fitting/uncertainty.h"

namespace hoplab {

/// One trial before any fit: what was recorded, and what the simulation makes of it at the nominal
/// values.
struct TrialCheck {
  std::string file;
  TrialRole role;
  long rows, samples;
  double duration_s;
  int hops_in_data;        // that the trace shows (HopsInData); -1 without body_y_m
  Outcome outcome;         // of the simulation at the nominal values
  int hops_in_simulation;  // likewise
  double end_time_s;       // where it ended
};

/// What `check` finds. Nothing in it stops a fit; what would is an InputError.
struct CheckReport {
  std::vector<std::string> warnings;  // what is legal but probably not meant
  std::vector<std::string> notes;     // what was decided on the way
  std::vector<TrialCheck> trials;
  /// Linearised at the nominal values; absent if no train trial could be simulated there.
  std::optional<Uncertainty> uncertainty;
  std::optional<GradientCertificate> certificate;
};

/// What is legal but probably not meant: SuspectThings, TurnedAxes and
/// SmoothedTraces.
std::vector<std::string> DataWarnings(const Dataset& dataset, const FitProblem& problem);

CheckReport CheckDataset(const Dataset& dataset, const FitProblem& problem, int jobs);

}  // namespace hoplab
