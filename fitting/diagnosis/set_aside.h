#pragma once

#include <optional>
#include <vector>

#include "fitting/diagnosis/calibration.h"
#include "fitting/diagnosis/name.h"
#include "fitting/diagnosis/other_models.h"

namespace hoplab {

/// A cause that the evidence wants and that is most likely not what its name says: the data are
/// told without it, and what it explained counts as left.
struct SetAside {
  int candidate = 0;  // place in Naming::candidates
  Candidate cause;
  Eigen::VectorXd values;    // in the model that had it, own units
  double share = 0.0;        // of what that model explains (CauseReport::share)
  double of_misfit = 0.0;    // of the plain model's misfit
  double probability = 0.0;  // that the name is right, calibrated
  double group_probability = 0.0, evidence_probability = 0.0;  // as CauseReport has them
  NameFeatures features;
  std::vector<int> group;  // it and what does as well in its place, by place
  /// Its values by the whole trials, where these do not confirm what first parts said.
  std::optional<Eigen::VectorXd> by_whole_trials = std::nullopt;
};

/// `model` without them, fitted and settled anew; as it was where it has none of them or was not
/// fitted. `null_problem`: of the model without causes.
FittedModel Without(const FittedModel& model, const std::vector<SetAside>& members,
                    const FitProblem& null_problem, const RefitSettings& settings);

/// Takes members out of `naming.best`, and out of every model compared with it; each is fitted and
/// settled anew. Groups, weights and gaps of the others stay. False, and nothing changed, if the
/// model without them could not be fitted. `null_problem`: of the model without causes.
bool TakeOut(const std::vector<SetAside>& members, const FitProblem& null_problem,
             const RefitSettings& settings, Naming& naming);

/// That all of these names are right, or others that do as well.
double ProbabilityOf(const std::vector<SetAside>& members);

/// Takes all members out: `null`, the model without causes, is left, and how likely the least
/// likely of them is says what is not listed.
void TakeAllOut(const std::vector<SetAside>& members, const FittedModel& null, Naming& naming);

/// No model with one of `members` more, or with what does as well in its place, is likelier than
/// that member, or than the told model where the whole trials do not confirm the member; those that
/// are then ruled out are dropped.
void Doubt(const std::vector<SetAside>& members, std::vector<OtherModel>& models);

}  // namespace hoplab
