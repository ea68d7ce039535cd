#pragma once

#include <cstdint>

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// The model as it is, fitted under white noise. `problem` is corrected (CorrectNoise).
DatasetFit FitPlain(FitProblem problem, const DiagnosisOptions& options, Segmentation span);

/// The first part of a diagnosis, and of a search for a formula: what FitPlain made, the noise that
/// suits it, and whether that can be trusted. Fills problem, by_hop, until, notes, fit, plain,
/// null, gate and, if it went wrong, refusal; `train` gets the train trials.
void BeginWith(DatasetFit fit, const DiagnosisOptions& options, Diagnosis& d,
               std::vector<TrialProblem>& train);

/// `problem` corrected (CorrectNoise), fitted and begun with.
void FitNull(FitProblem problem, const DiagnosisOptions& options, Diagnosis& d,
             std::vector<TrialProblem>& train);

/// What the refits of a diagnosis share.
RefitSettings SettingsOf(const DiagnosisOptions& options, const std::vector<TrialProblem>& train);

/// All tests of a linearisation whose columns are `candidates`, then the probes.
Detection Detect(const Linearisation& at, std::span<const Candidate> candidates,
                 const ProbeBasis& basis, std::uint64_t seed);

}  // namespace hoplab
