#pragma once

#include "app/records/run_record.h"
#include "app/runs/diagnosis_run.h"

namespace hoplab {

/// run.json of a diagnosis, `seconds` excepted; `dataset_argument` as on the command line. SI
/// units, radians; what was not computed is null.
Json DiagnosisRecord(const Dataset& dataset, const std::string& dataset_argument,
                     const DiagnosisOptions& options, const DiagnosisRun& run);

}  // namespace hoplab
