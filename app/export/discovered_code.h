#pragma once

#include <map>
#include <string>

#include "fitting/discovery/discover.h"

namespace hoplab {

/// What is found as C++ effects (docs/adding/effect.md): discovered.cc, discovered_2.cc, ...; none
/// of a term that a compiled effect cannot know.
std::map<std::string, std::string> DiscoveryCode(const Discovery& d);
/// Which those are, for a terminal.
std::string CodeReport(const Discovery& d, bool colours);

}  // namespace hoplab
