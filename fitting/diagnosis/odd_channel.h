#pragma once

#include <functional>
#include <optional>

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Diagnoses `problem`, made of `dataset`, with its options.
using Diagnosing =
    std::function<Diagnosis(const Dataset& dataset, const DiagnosisOptions& options)>;

/// Whether a dataset has sensors beside those of its body's pose: their channels may be read at
/// another time, or be wrong, which no cause of the body's motion explains.
bool HasOtherSensors(const Dataset& dataset);

/// A diagnosis of a dataset that has some. Where something is missing, and nothing is once one
/// channel has a clock of its own, that is what is told. Where nothing is without a channel at all,
/// and no single cause explains it either, the channel is left out and told.
Diagnosis DiagnoseWithOddChannel(const Dataset& dataset, const DiagnosisOptions& options,
                                 const Diagnosing& diagnose);

}  // namespace hoplab
