#pragma once

#include "fitting/fit.h"

namespace hoplab::bench {

/// Everything between a dataset on disk and its optimum, as `hoplab fit datasets/rig-drops` does
/// it: read, set up (law large_deflection, E and d free), one start on two threads.
FitResult FitRigDrops();

}  // namespace hoplab::bench
