#pragma once

#include <cstddef>
#include <optional>

#include "fitting/stray_samples.h"

namespace hoplab {

/// The sample at the top of the last flight of a body that falls: it sinks below `lowest_m`, where
/// no leg is left to carry it, stays below for a tenth of a second at least, to the end, and does
/// not rise by 15 mm any more, as a body does that hops downhill. A flight has three samples in a
/// row above `lands_m`, where the leg lands. `doubt`: of a height [m].
std::optional<std::size_t> FindTopBeforeFall(const Samples& heights, double lands_m,
                                             double lowest_m, double doubt);

}  // namespace hoplab
