#pragma once

#include <string>

#include "experiments/study/reproduction.h"

namespace hoplab {

/// What the command prints.
std::string ReproductionReport(const std::string& name, const Reproduction& reproduction,
                               bool colours);

}  // namespace hoplab
