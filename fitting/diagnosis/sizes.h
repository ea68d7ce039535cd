#pragma once

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Whether sizes of each trial's own are worth telling: they explain a `material` share more of
/// what the extension explains, or take a held-out error down, as a main cause does (IsMainCause),
/// and no held-out error is a twentieth larger with them, nor lost. Where nothing is held out the
/// train trials decide.
bool SizesMatter(const SizesReport& sizes, const ExtensionReport& report, double material);

/// Refits the extension with a size in each trial of told causes that vary and might matter, and
/// fills in `report.sizes` and each cause's `refitted`. Leaves all else as it is.
void MeasureSizes(ExtensionReport& report, const Diagnosis& diagnosis, double material,
                  std::uint64_t seed, const RefitSettings& settings);

}  // namespace hoplab
