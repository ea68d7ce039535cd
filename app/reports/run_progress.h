#pragma once

#include "app/runs/fit_run.h"
#include "app/runs/reproduce_settings.h"
#include "app/terminal/progress.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Lets `progress` say how far a fit is, and `console` what its check warns of.
void ShowProgress(FitRunOptions& options, Progress& progress, const Console& console);
/// Lets it say how far a diagnosis is.
void ShowProgress(DiagnosisOptions& options, Progress& progress, const Console& console);
/// Lets it say how far a reproduction is.
void ShowProgress(ReproductionRequest& request, Progress& progress);

}  // namespace hoplab
