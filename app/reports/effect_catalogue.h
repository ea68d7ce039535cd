#pragma once

#include <string>
#include <vector>

#include "model/effects/effect.h"

namespace hoplab {

/// The effects as a page in Markdown: by kind, each with its equation, parameters and laws.
std::string EffectCatalogue(const std::vector<const Effect*>& effects);

}  // namespace hoplab
