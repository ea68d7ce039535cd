#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/dataset.h"
#include "fitting/check.h"
#include "fitting/fit.h"
#include "fitting/fit_dataset.h"
#include "fitting/gradient_certificate.h"
#include "fitting/objective.h"
#include "fitting/profile.h"
#include "fitting/trial_errors.h"
#include "fitting/uncertainty.h"

namespace hoplab {

struct FitRunOptions {
  ProblemOptions problem;
  FitOptions fit;
  Segmentation span = Segmentation::kAuto;
  std::vector<std::string> profile;  // shared parameters, or "all"
  /// Called where a stage begins.
  std::function<void(std::string_view stage)> stage = nullptr;
  /// Called with what the check found, before the search.
  std::function<void(const CheckReport&)> checked = nullptr;
};

/// What a fit's values are worth.
enum class FitStanding {
  kOk,
  kPartial,  // a minimum, but of a part of the data: some hops cannot be simulated, or
             // trials can be followed for a while only
  kStuck,    // where a search stopped that is no minimum: its values are no result
  kFailed    // nothing to report
};
std::string_view NameOf(FitStanding standing);

/// All that `hoplab fit` computes: the search, then what its optimum is worth. What follows the
/// search is absent if it led nowhere.
struct FitRun {
  FitProblem problem;  // trials are single hops if `by_hop`
  CheckReport check;
  bool by_hop = false;
  std::optional<double> until;  // s, where trials were fitted up to there only
  std::string why_in_part;      // empty where whole trials were fitted
  std::string note;  // why it was fitted hop by hop, or that hops and whole traces disagree
  FitResult fit;
  std::vector<std::string> left_out;  // train hops that no values found let be simulated
  /// At least one start ran to its end: there is something to report.
  bool has_result = false;
  /// Stopped from outside; profiles may be missing, restarts are.
  bool interrupted = false;
  /// Of the train trials, where the search begins (nominal values and initial states) and at the
  /// optimum.
  std::optional<Objective> at_nominal, at_optimum;
  std::optional<Uncertainty> uncertainty;
  std::optional<GradientCertificate> certificate;
  std::vector<TrialErrors> trials;
  std::vector<Profile> profiles;

  /// Why no fit was tried; empty if one was.
  std::string refusal;
  /// What speaks against a minimum, one sentence each; absent without a result.
  std::vector<std::string> faults;
  /// What is odd in what was fitted, beside what the check found.
  std::vector<std::string> warnings;

  FitStanding Standing() const;
  int finished_restarts() const;
  /// The data say nothing about it: the value found is an accident of the start.
  bool Undetermined(int parameter) const;
  bool AllUndetermined() const;
  /// Why there is no usable result; empty if there is one.
  std::string Failure() const;
  /// What a reader must know first: why it is no result, or not of all data; empty if it is.
  std::string Caveat() const;
};

/// Checks, fits and assesses. Throws InputError for options that do not suit the dataset.
FitRun RunFit(const Dataset& dataset, const FitRunOptions& options);

}  // namespace hoplab
