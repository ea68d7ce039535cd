#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect hip_coulomb_friction_4 =
    MakeEffect<effect_detail::HipCoulombFrictionOf<4>>();
}
