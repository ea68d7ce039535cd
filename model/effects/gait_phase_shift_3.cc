#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect gait_phase_shift_3 = MakeEffect<effect_detail::GaitPhaseShift<3>>();
}
