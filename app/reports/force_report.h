#pragma once

#include <string>

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// The free forces that a diagnosis found: sizes and shapes of what no cause of the list explains.
std::string ForceLines(const FreeForces& free_forces, bool colours);

}  // namespace hoplab
