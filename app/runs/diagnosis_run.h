#pragma once

#include <string>

#include "fitting/diagnosis/diagnosis.h"
#include "fitting/diagnosis/energy_ledger.h"

namespace hoplab {

/// All that `hoplab diagnose` computes.
struct DiagnosisRun {
  Diagnosis diagnosis;
  EnergyLedger energy;

  /// Why there is no verdict; empty if there is one.
  std::string Failure() const;
  /// Something is left that no listed cause explains, or that is likely: a formula may.
  bool WantsFormula() const;
};

/// Diagnoses a dataset and balances its energy. Throws InputError for options that do not suit it.
DiagnosisRun RunDiagnosis(const Dataset& dataset, const DiagnosisOptions& options);

}  // namespace hoplab
