#pragma once

#include <string>

#include "experiments/identification/identification.h"

namespace hoplab {

/// What the command prints.
std::string IdentifyReport(const IdentificationRequest& request, const IdentificationResult& result,
                           bool colours);

}  // namespace hoplab
