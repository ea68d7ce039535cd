#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect leg_damping_4 = MakeEffect<effect_detail::LegDamping<4>>();
}
