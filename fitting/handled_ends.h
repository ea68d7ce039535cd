#pragma once

#include <cstddef>
#include <optional>

#include "fitting/stray_samples.h"

namespace hoplab {

/// Where a body that was held is let go.
struct Release {
  std::size_t first = 0;               // the first sample after it
  double time_s = 0.0, doubt_s = 0.0;  // when it was, and one standard deviation of that
  double rise_m = 0.0;                 // how far it was lifted since the first sample
};
/// The heights that a record begins with, if a hand holds the body or moves it evenly and then lets
/// it fall: a line, and from one instant on the parabola of -g beside it, 30 mm deep. It must
/// miss by no more than noise, and both a fall from the first sample on and any other parabola by
/// far more: a body that falls against friction does not begin to fall late. A body that stands
/// does not fall free. `gravity` [m/s^2], positive.
std::optional<Release> FindRelease(const Samples& heights, double sigma, double gravity);

/// The first sample of those at the end of a record at which the body is no longer free, if it
/// rests in the air there for a tenth of a second, a centimetre above `lands_m`, and has been below
/// that before: somebody caught it. `lands_m`: above this height no leg carries it.
std::optional<std::size_t> FindCatch(const Samples& heights, double sigma, double gravity,
                                     double lands_m);

/// The sample at the top of the first flight of a record that begins in a stance. Where it is said
/// to begin in flight (`said`), its first sample lies 3 mm and `doubt` below `lands_m`, where the
/// leg lands, and it or a later one 15 mm; else its first sample lies 1 mm and `doubt` below. It
/// rises above that later, and what is left from there on is no less than `fewest` samples.
std::optional<std::size_t> FindTopAfterStance(const Samples& heights, bool said, double lands_m,
                                              double doubt, std::size_t fewest);

}  // namespace hoplab
