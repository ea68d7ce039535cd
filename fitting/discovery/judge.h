#pragma once

#include "fitting/discovery/discover.h"

namespace hoplab {

/// Sets verdict and reason of a search whose terms are found and measured.
void Judge(Discovery& out);

}  // namespace hoplab
