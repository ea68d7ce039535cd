#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct MotorKpScale {
  static constexpr std::array kParameters = {EffectParameter{"gamma", "-", 0.0, -0.9, 20.0, 0.1}};
  static constexpr EffectInfo kInfo = {.name = "motor_kp_scale",
                                       .kind = EffectKind::kParameter,
                                       .equation = "kp (1 + gamma) in M75 (M108)",
                                       .sentence =
                                           "the motors hold their angle more or less stiffly than "
                                           "stated: another gain, another unit",
                                       .for_legs = false,
                                       .for_ball = false,
                                       .dissipative = false,
                                       .parameters = kParameters,
                                       .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->motor_kp *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect motor_kp_scale = MakeEffect<MotorKpScale>();
}
}  // namespace hoplab
