#pragma once

#include <optional>
#include <string>

#include "app/records/diagnosis_record.h"
#include "fitting/discovery/discover.h"

namespace hoplab {

/// A diagnosis in words, for a terminal: the verdict, where the misfit sits, the cause and its
/// size, what the extended model gains, what is excluded, what could not have shown, what to record
/// next. `formula_sought`: a formula was looked for beside it, so nothing points to that.
std::string DiagnosisReport(const Dataset& dataset, const DiagnosisRun& run, bool formula_sought,
                            bool colours);
/// What was found where a formula was looked for beside it; absent: none was needed.
std::string FormulaReport(const DiagnosisRun& run, const std::optional<Discovery>& discovery,
                          bool colours);

}  // namespace hoplab
