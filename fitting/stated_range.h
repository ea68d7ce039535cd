#pragma once

#include <string>

#include "base/range.h"
#include "model/parameters.h"

namespace hoplab {

/// What a dataset or a scenario may state of a parameter of the mechanism `of`, in the unit of the
/// parameter.
Range StatedRange(ParameterId id, MechanismKind mechanism, const Parameters<double>& of);

/// Throws InputError, place `place`, for a value outside of it.
void CheckStatedValue(ParameterId id, double value, MechanismKind mechanism,
                      const Parameters<double>& of, const std::string& name,
                      const std::string& place);

}  // namespace hoplab
