#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct GaitDutyShift {
  static constexpr double kLeast = 0.02;  // of either part of a turn
  static constexpr std::array kParameters = {EffectParameter{"shift", "-", 0.0, -0.3, 0.3, 0.02}};
  static constexpr EffectInfo kInfo = {
      .name = "gait_duty_shift",
      .kind = EffectKind::kParameter,
      .equation = "duty + shift in M76, kept within 0.02 and 0.98 (M110)",
      .sentence =
          "the slow part of every turn of the robot's clock is another share of it than stated",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    T& duty = parameters.robot->duty;
    duty += p[0];
    if (Value(duty) < kLeast) duty = T(kLeast);
    if (Value(duty) > 1.0 - kLeast) duty = T(1.0 - kLeast);
  }
};

}  // namespace

namespace effects {
extern constexpr Effect gait_duty_shift = MakeEffect<GaitDutyShift>();
}
}  // namespace hoplab
