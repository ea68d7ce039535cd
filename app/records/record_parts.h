#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/records/run_record.h"
#include "fitting/diagnosis/candidate.h"
#include "fitting/fit_dataset.h"
#include "fitting/gradient_certificate.h"
#include "fitting/trial_errors.h"
#include "fitting/uncertainty.h"

namespace hoplab {

// Parts of run.json that several commands share. SI units, radians; what was not computed is null.

Json IntervalRecord(const std::optional<std::pair<double, double>>& interval);

/// Values by the shared parameters' names.
template <class Values>
Json ByParameter(const FitProblem& problem, const Values& values) {
  Json out = Json::object();
  for (int i = 0; i < problem.shared_count(); ++i)
    out[problem.shared[i].name] = NumberOrNull(values[i]);
  return out;
}

/// Values in the order of the problem's channels, by the channels' names.
Json ByChannel(const FitProblem& problem, const std::vector<double>& values);

/// Shared values as a fit found them; null where there are none.
struct FittedValues {
  const FitProblem* problem = nullptr;
  const Eigen::VectorXd* shared = nullptr;
  const Uncertainty* uncertainty = nullptr;
};
Json ParametersRecord(const FittedValues& fitted);

/// Errors over the trials of one role; nulls if no trial was assessed.
Json RoleRecord(const FitProblem& problem, const std::vector<TrialErrors>& trials, TrialRole role);
/// `trials` in the problem's order.
Json TrialsRecord(const FitProblem& problem, const std::vector<TrialErrors>& trials);

/// Rows and columns by the shared parameters' names.
Json MatrixRecord(const FitProblem& problem, const Eigen::MatrixXd& matrix);
Json IdentifiabilityRecord(const FitProblem& problem, const Identifiability& identifiability);
Json CertificateRecord(const std::optional<GradientCertificate>& certificate);
Json ChannelsRecord(const FitProblem& problem);
/// What the set-up rules out or bounds, one entry a parameter: [{"effect", "parameter", "unit",
/// "at_most"}]; at_most 0: it is not there.
Json KnownRecord(const FitProblem& problem);
/// What the traces show that no body does: [{"kind" ("stray", "held", "jump"), "file", "channel",
/// "unit", "times_s", "largest", "compared"}].
Json TraceFaultsRecord(const FitProblem& problem, const Dataset& dataset);
/// Effects that are formulas, those simulated and those tried: [{"name", "acts_as", "symbol",
/// "unit", "formula", "mathml", "sentence", "parameters"}].
Json FormulasRecord(const FitProblem& problem);
Json FormulaRecord(const Effect& effect);
Json ToolsRecord();

/// What of the trials was fitted: "fitted" ("whole traces", "single hops", "first parts") and
/// "fitted_until_s", null unless trials were fitted up to there only.
void RecordSpan(bool by_hop, std::optional<double> until, Json& record);

/// How a problem was set up and fitted.
struct FitConfiguration {
  std::string dataset_argument;  // as on the command line
  const ProblemOptions* problem_options = nullptr;
  const FitOptions* fit = nullptr;
  Segmentation span = Segmentation::kAuto;
};

/// The whole resolved configuration, what does not change a result (jobs, places) left out.
Json OptionsRecord(const FitProblem& problem, const FitConfiguration& configuration);

/// What a model leaves beside white noise, by channel: the discrepancy's amplitude (one standard
/// deviation, the channel's unit) and time scale; null where there is none.
Json LeftRecord(const FitProblem& problem);

/// The text; null where there is none.
Json TextOrNull(const std::string& text);
/// The file of the one trial that a cause acts in; null where that is not one.
Json OneTrial(const Candidate& cause);

}  // namespace hoplab
