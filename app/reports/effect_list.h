#pragma once

#include <string>
#include <vector>

#include "model/effects/effect.h"

namespace hoplab {

/// Two lines an effect: name, parameters with their typical sizes, restriction; what it is.
std::string EffectListText(const std::vector<const Effect*>& effects, bool colours);

/// One effect in full; `given`: as it was asked for, by name or file.
std::string EffectText(const Effect& effect, const std::string& given, bool colours);

}  // namespace hoplab
