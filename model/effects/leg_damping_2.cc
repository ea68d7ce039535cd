#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect leg_damping_2 = MakeEffect<effect_detail::LegDamping<2>>();
}
