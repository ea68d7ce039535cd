#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect backlash_2 = MakeEffect<effect_detail::Backlash<2>>();
}
