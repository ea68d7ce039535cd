#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect hip_viscous_friction_2 =
    MakeEffect<effect_detail::HipViscousFrictionOf<2>>();
}
