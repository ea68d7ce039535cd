#pragma once

#include <string>
#include <vector>

#include "app/runs/fit_run.h"

namespace hoplab {

// Sentences on a fit that its record, its report and `check` have in common.

/// What the data leave open, or that they leave nothing open. `at` says where the problem was
/// linearised: "" or " at the start values".
std::string DeterminedLine(const FitProblem& problem, const Uncertainty& uncertainty,
                           const std::string& at);
/// That the model misses more than the noise, of a fit where it does.
std::string MisfitLine(const FitProblem& problem, const Uncertainty& uncertainty);
std::string CertificateLine(const std::optional<GradientCertificate>& certificate);
/// Stiffnesses that ended ten times off where the model misses something, trials whose simulation
/// did not reach the end of their data, and legs bent beyond the law.
std::vector<std::string> Remarks(const FitRun& run);

/// "body_x 0.41 mm, body_y 0.91 mm over 109 ms": the discrepancy beside white noise.
std::string LeftText(const FitProblem& problem);

}  // namespace hoplab
