#pragma once

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// How sure each name of `report` is, by what cases that looked like it turned out to be
/// (NameFeatures). `sizes`: of the shared values of the extension.
void Believe(ExtensionReport& report, const Diagnosis& diagnosis,
             const std::vector<Heterogeneity>& sizes);

}  // namespace hoplab
