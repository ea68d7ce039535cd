#pragma once

#include <string>

#include "app/fit_run.h"

namespace hoplab {

/// What a fit found, for a terminal: one line a parameter, then what is weakly determined, errors
/// and the gradient certificate. Engineering units; the exact numbers are in run.json.
std::string FitReport(const Dataset& dataset, const FitRun& run, bool colours);

// Lines that `check` shows too, without indentation.

/// What the data leave open, or that they leave nothing open. `at` says where the problem was
/// linearised: "" or " at the start values".
std::string DeterminedLine(const FitProblem& problem, const Uncertainty& uncertainty,
                           const std::string& at);
/// That the model misses more than the noise, of a fit where it does.
std::string MisfitLine(const FitProblem& problem, const Uncertainty& uncertainty);
std::string CertificateLine(const std::optional<GradientCertificate>& certificate);
/// Trials whose simulation did not reach the end of their data, and legs bent beyond the law.
std::vector<std::string> TrialRemarks(const FitRun& run);

}  // namespace hoplab
