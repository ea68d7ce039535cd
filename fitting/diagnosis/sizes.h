#pragma once

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Refits the extension with a size in each trial of the told causes that vary, and fills in
/// `report.sizes` and each cause's `refitted`. Leaves all else as it is.
void MeasureSizes(ExtensionReport& report, const Diagnosis& diagnosis,
                  const RefitSettings& settings);

}  // namespace hoplab
