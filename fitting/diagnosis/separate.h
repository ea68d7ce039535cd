#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fitting/design/trial_design.h"
#include "fitting/diagnosis/fitted_model.h"

namespace hoplab {

/// The trial that tells rival models apart best, with what it is expected to bring.
struct SeparatingExperiment {
  TrialDesign design;
  /// Expected log-likelihood ratio against the closest rival, after that one has been refitted to
  /// old and new data together [nats].
  double expected_nats = 0.0;
  std::string closest_rival;  // name of what the best model is hardest to tell from
  int designs_tried = 0;
  /// Enough to settle it.
  bool Separates() const;
};

/// Searches what another drop like the train trials could be (PlainSpace) for the one that leaves
/// the least doubt between the rivals, taken as equally likely. Absent if there is no rival or no
/// design can be simulated under all of them.
std::optional<SeparatingExperiment> ProposeExperiment(std::span<const FittedModel> rivals,
                                                      const std::vector<TrialProblem>& train,
                                                      int jobs);

}  // namespace hoplab
