#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect leg_stiffness_3 = MakeEffect<effect_detail::LegStiffness<3>>();
}
