#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect leg_damping_1 = MakeEffect<effect_detail::LegDamping<1>>();
}
