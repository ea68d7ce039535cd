#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect motor_gain_1 = MakeEffect<effect_detail::MotorGainOf<1>>();
}
