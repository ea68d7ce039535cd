#pragma once

#include "experiments/identification/identification.h"

namespace hoplab {

/// What the fits of an identification say together: how far the good ones lie apart, which
/// directions the tables see, what decides each open point, by which reading the times do best, and
/// which cells pull.
void AddFindings(const IdentificationRequest& request, IdentificationResult& result);

}  // namespace hoplab
