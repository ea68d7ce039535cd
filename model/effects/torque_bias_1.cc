#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect torque_bias_1 = MakeEffect<effect_detail::TorqueBiasOf<1>>();
}
