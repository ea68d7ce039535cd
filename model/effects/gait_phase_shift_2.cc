#include "model/effects/robot_leg.h"

namespace hoplab::effects {
extern constexpr Effect gait_phase_shift_2 = MakeEffect<effect_detail::GaitPhaseShift<2>>();
}
