#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect gait_phase_shift_4 = MakeEffect<effect_detail::GaitPhaseShift<4>>();
}
