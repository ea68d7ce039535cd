#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/records/diagnosis_record.h"

namespace hoplab {

/// The CSVs behind a diagnosis' plots by file name: candidates, misfit, residuals, trajectories
/// and events (of the model before and after), evidence (for the effects of the extension), forces
/// (where free ones were reconstructed), energy. Times are those of the dataset's own files. What
/// was not reached is left out.
std::map<std::string, std::string> DiagnosisTables(const DiagnosisRun& run);

/// Evidence for effects that a model lacks, beside its fitted values: row by row and summed up
/// since the trial's first; an effect of some trials only counts there. `names`: of the members.
std::string EvidenceTable(const FittedModel& null, std::span<const Candidate> members,
                          const std::vector<std::string>& names);

/// Measured, simulated before, and with the extended model's errors simulated after.
std::string ResidualsTable(const Diagnosis& d, const HeldOutErrors* extended);

}  // namespace hoplab
