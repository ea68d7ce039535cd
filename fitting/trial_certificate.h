#pragma once

#include <vector>

#include "fitting/gradient_certificate.h"

namespace hoplab {

/// What a certificate says of one trial.
struct TrialCertificate {
  /// |analytic - differences| / |analytic| of each column, shared values first; NaN: the column is
  /// zero in both, is not free or could not be checked.
  std::vector<double> errors;
  std::vector<CertificateFlag> flags;
};

/// Of CertifyGradients alone, which says how. `source` may be empty.
TrialCertificate CertifyTrial(const FitProblem& problem, const TrialProblem& trial,
                              const Eigen::VectorXd& shared, const OwnValues& start,
                              const JacobianSource& source);

}  // namespace hoplab
