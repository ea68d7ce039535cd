#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect leg_zero_offset = MakeEffect<effect_detail::LegZeroOffset<0>>();
}
