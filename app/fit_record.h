#pragma once

#include "app/fit_run.h"
#include "app/run_record.h"

namespace hoplab {

/// The whole resolved configuration of a fit, what does not change its result (jobs, places) left
/// out. `dataset_argument` as on the command line.
Json OptionsRecord(const std::string& dataset_argument, const FitProblem& problem,
                   const FitRunOptions& options);

/// run.json of a fit, `seconds` excepted. SI units, radians; what was not computed is null.
Json FitRecord(const Dataset& dataset, const std::string& dataset_argument,
               const FitRunOptions& options, const FitRun& run);

// Parts that `check` records too.
Json IdentifiabilityRecord(const FitProblem& problem, const Identifiability& identifiability);
Json CertificateRecord(const std::optional<GradientCertificate>& certificate);
Json ChannelsRecord(const FitProblem& problem);
Json ToolsRecord();

}  // namespace hoplab
