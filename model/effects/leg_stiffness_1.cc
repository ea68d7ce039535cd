#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect leg_stiffness_1 = MakeEffect<effect_detail::LegStiffness<1>>();
}
