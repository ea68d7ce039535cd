#pragma once

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Refits the extension with a size in each trial of told causes that vary and might matter, and
/// fills in `report.sizes` and each cause's `refitted`. Leaves all else as it is.
void MeasureSizes(ExtensionReport& report, const Diagnosis& diagnosis, double material,
                  std::uint64_t seed, const RefitSettings& settings);

}  // namespace hoplab
