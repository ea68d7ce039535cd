#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fitting/fit_dataset.h"
#include "fitting/trial_errors.h"
#include "fitting/uncertainty.h"

namespace hoplab {

/// One way of explaining a dataset: a law, and effects whose parameters are freed.
struct ComparedModel {
  std::string law;
  std::vector<std::string> with_effects;
};

/// What one model made of the dataset.
struct ModelResult {
  ComparedModel model;
  DatasetFit fit;
  Uncertainty uncertainty;  // meaningful if fit.result.ok
  RoleErrors train, test;   // likewise
};

struct LawComparison {
  std::vector<ModelResult> rows;  // in the order asked for
};

/// The options of one model: `options` with its law and effects.
ProblemOptions OptionsOf(const ComparedModel& model, ProblemOptions options);

/// Fits the same dataset with each model; what is fixed and freed otherwise is the same for all.
/// `progress` is called after each.
LawComparison CompareLaws(const Dataset& dataset, const std::vector<ComparedModel>& models,
                          const ProblemOptions& problem_options, const FitOptions& fit_options,
                          Segmentation span = Segmentation::kAuto,
                          const std::function<void(int done)>& progress = nullptr);

/// Every law of the dataset's mechanism, the default first, without effects.
std::vector<ComparedModel> AllLaws(const Dataset& dataset);

}  // namespace hoplab
