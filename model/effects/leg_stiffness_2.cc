#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect leg_stiffness_2 = MakeEffect<effect_detail::LegStiffness<2>>();
}
