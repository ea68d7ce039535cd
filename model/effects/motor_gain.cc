#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct MotorGain {
  static constexpr std::array kParameters = {EffectParameter{"gamma", "-", 0.0, -0.9, 2.0, 0.05}};
  static constexpr EffectInfo kInfo = {
      .name = "motor_gain",
      .kind = EffectKind::kParameter,
      .equation = "a motor gives (1 + gamma) of the torque it is told",
      .sentence = "the robot's motors are weaker or stronger than their controller thinks",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true,
      .scales = BitsOfFamily(InputKind::kHipTorque)};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->motor_gain *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect motor_gain = MakeEffect<MotorGain>();
}
}  // namespace hoplab
