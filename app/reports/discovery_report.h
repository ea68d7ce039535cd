#pragma once

#include <string>

#include "fitting/discovery/discover.h"

namespace hoplab {

/// What the terminal shows.
std::string DiscoveryReport(const Discovery& d, bool colours);

}  // namespace hoplab
