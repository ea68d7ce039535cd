#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect backlash = MakeEffect<effect_detail::Backlash<0>>();
}
