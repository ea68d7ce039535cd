#include <algorithm>
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
      .equation = "duty + shift in M76, no nearer to 0 and 1 than 0.02 or the stated duty (M110)",
      .sentence =
          "the slow part of every turn of the robot's clock is another share of it than stated",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true,
      .about = MachinePart::kClock};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    T& duty = parameters.robot->duty;
    const double least = std::min(kLeast, Value(duty));
    const double most = std::max(1.0 - kLeast, Value(duty));
    duty += p[0];
    if (Value(duty) < least) duty = T(least);
    if (Value(duty) > most) duty = T(most);
  }
};

}  // namespace

namespace effects {
extern constexpr Effect gait_duty_shift = MakeEffect<GaitDutyShift>();
}
}  // namespace hoplab
