#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/fit.h"

namespace hoplab {

/// One column of the sensitivities held against Richardson differences of the simulation.
struct CertificateColumn {
  std::string name;   // "E", "train-1.csv.vx0"
  std::string trial;  // the worst trial for a shared value
  /// |analytic - differences| / |analytic|; absent where the column is zero in both.
  std::optional<double> relative_error;
};

/// What a run came close to, where derivatives end.
struct CertificateFlag {
  std::string trial;
  std::string text;  // grazing, simultaneous events, another event sequence nearby
};

struct GradientCertificate {
  double max_relative_error = 0.0;  // NaN if no column could be checked
  std::string worst_parameter;
  /// The same over the trials without a flag; NaN where each has one.
  double max_error_without_flags = 0.0;
  std::vector<CertificateColumn> columns;
  std::vector<CertificateFlag> flags;
};

/// Simulates a trial with the sensitivities to be checked: the evaluator's own for a certificate,
/// or another supplier's, which is how the certificate itself is tested.
using JacobianSource =
    std::function<void(const TrialEvaluator&, const EvaluationRequest&, Trajectory&)>;

/// Checks every shared value in every train trial and every start component, at `shared` and
/// `initial_states`. Rows within reach of an event that jumps are left out of the comparison (a
/// finite difference cannot straddle a jump). Where a shifted run has its events in another order
/// the step is cut; where the other order begins right beside the values, differences are those of
/// one side, and a flag says so.
GradientCertificate CertifyGradients(const FitProblem& problem,
                                     const std::vector<TrialProblem>& trials,
                                     const Eigen::VectorXd& shared,
                                     const std::vector<OwnValues>& initial_states, int jobs,
                                     const JacobianSource& source = nullptr);

}  // namespace hoplab
