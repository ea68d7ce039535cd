#pragma once

#include <string>

#include "fitting/discovery/discover.h"

namespace hoplab {

/// "a force on the body along its velocity, against it, with the square of the speed".
std::string WordsOf(const FoundTerm& found);

/// "c = -0.0520 +- 0.0040 N s^2/m^2, p = 2".
std::string SizesOf(const FoundTerm& found);

/// What physics says of a term, told and not used to sort out: whether it takes energy, asks for a
/// direction, acts in flight.
std::string PhysicsOf(const FoundTerm& found);

/// A found term as the effect that is written to a file: "discovered", "discovered_2", ...
FormulaSource WrittenSource(const FoundTerm& found, std::size_t place);

/// A file of the format hoplab-effect/1.
std::string EffectFileText(const FormulaSource& source, const std::string& remark);

/// "discovered.yaml", then "discovered-2.yaml", ...
std::string DiscoveredFile(std::size_t place);

}  // namespace hoplab
