#include <array>
#include <cmath>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct TorqueLimitLoss {
  static constexpr std::array kParameters = {EffectParameter{"loss", "-", 0.0, -20.0, 0.95, 0.3}};
  static constexpr EffectInfo kInfo = {
      .name = "torque_limit_loss",
      .kind = EffectKind::kParameter,
      .equation = "limit (1 - loss) in M75 (M109)",
      .sentence =
          "the robot's motors give less, or more, at most than stated: a battery that sags, a "
          "current limit",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .has_threshold = true,
      .parameters = kParameters,
      .for_robot = true,
      .about = MachinePart::kTorqueLimit};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    T& limit = parameters.robot->torque_limit;
    if (std::isfinite(Value(limit))) limit *= 1.0 - p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect torque_limit_loss = MakeEffect<TorqueLimitLoss>();
}
}  // namespace hoplab
