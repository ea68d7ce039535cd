#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect hip_viscous_friction_4 =
    MakeEffect<effect_detail::HipViscousFrictionOf<4>>();
}
