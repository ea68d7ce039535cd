#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/dataset.h"
#include "fitting/design/design_search.h"
#include "fitting/fit_dataset.h"

namespace hoplab {

struct DesignRunOptions {
  ProblemOptions problem;
  FitOptions fit;  // jobs, stop and seed serve the whole run
  Segmentation span = Segmentation::kAuto;
  std::vector<std::string> causes;  // effects to tell apart; one: from no effect
  std::string sharpen;              // a shared value; with neither, a diagnosis decides
  std::vector<DesignRange> space;   // over the default ranges
  int budget = DesignSearchRequest().budget;
  int map_size = 13;
  std::function<void(std::string_view stage)> stage = nullptr;
  std::function<void(const std::string& text, int done, int of)> step = nullptr;
};

/// All that `hoplab design` computes.
struct DesignRun {
  FitProblem problem;              // the model without further effects
  std::vector<std::string> notes;  // what was decided on the way
  std::string failure;             // why there is no design; empty if there is one
  bool interrupted = false;
  bool separates = true;  // the task; false: sharpens a value
  std::string decision;   // why the diagnosis chose the task; empty where it was given

  std::vector<FittedModel> rivals;    // the causes told apart
  std::vector<double> probabilities;  // of the rivals, by the recorded trials
  /// The recorded trials tell them apart already: worths count as if they did not.
  bool even_odds = false;

  FittedModel model;  // whose value is sharpened
  int parameter = 0;  // its place among the shared values

  DesignSpace space;
  DesignSearchResult search;

  /// "touchdown_loss and touchdown_angle_bias".
  std::string RivalNames() const;
  const SharedParameter& Sharpened() const {
    return model.problem.shared[static_cast<std::size_t>(parameter)];
  }
};

/// Fits what the task needs and searches the trial to record next. Throws InputError for options
/// that do not suit the dataset.
DesignRun RunDesign(const Dataset& dataset, const DesignRunOptions& options);

}  // namespace hoplab
