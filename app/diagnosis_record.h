#pragma once

#include "app/run_record.h"
#include "fitting/diagnosis/diagnosis.h"
#include "fitting/diagnosis/energy_ledger.h"

namespace hoplab {

/// All that `hoplab diagnose` computes.
struct DiagnosisRun {
  Diagnosis diagnosis;
  EnergyLedger energy;

  /// Why there is no verdict; empty if there is one.
  std::string Failure() const;
};

/// run.json of a diagnosis, `seconds` excepted; `dataset_argument` as on the command line. SI
/// units, radians; what was not computed is null.
Json DiagnosisRecord(const Dataset& dataset, const std::string& dataset_argument,
                     const DiagnosisOptions& options, const DiagnosisRun& run);

}  // namespace hoplab
