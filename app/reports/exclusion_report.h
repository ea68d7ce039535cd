#pragma once

#include <string>

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Which causes a diagnosis rules out, at which size, and which it could not have seen.
std::string ExclusionLines(const Diagnosis& d, bool colours);

}  // namespace hoplab
