#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct MotorLag {
  static constexpr std::array kParameters = {EffectParameter{"t_lag", "s", 0.0, 0.0, 0.1, 0.002}};
  static constexpr EffectInfo kInfo = {
      .name = "motor_lag",
      .kind = EffectKind::kParameter,
      .equation =
          "t_lag dtau/dt = tau_told - tau of every motor, tau = tau_told at the start (M86)",
      .sentence = "the robot's motors follow what they are told only after a while",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->motor_lag += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect motor_lag = MakeEffect<MotorLag>();
}
}  // namespace hoplab
