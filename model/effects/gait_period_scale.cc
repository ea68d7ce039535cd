#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct GaitPeriodScale {
  static constexpr std::array kParameters = {EffectParameter{"gamma", "-", 0.0, -0.5, 1.0, 0.01}};
  static constexpr EffectInfo kInfo = {.name = "gait_period_scale",
                                       .kind = EffectKind::kParameter,
                                       .equation = "period (1 + gamma) in M76 (M110)",
                                       .sentence =
                                           "a turn of the clock that the robot's motors follow "
                                           "takes longer, or less long, than stated",
                                       .for_legs = false,
                                       .for_ball = false,
                                       .dissipative = false,
                                       .parameters = kParameters,
                                       .for_robot = true,
                                       .about = MachinePart::kClock};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->period *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect gait_period_scale = MakeEffect<GaitPeriodScale>();
}
}  // namespace hoplab
