#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct TorqueGain {
  static constexpr std::array kParameters = {EffectParameter{"gain", "-", 0.0, -0.9, 5.0, 0.05}};
  static constexpr EffectInfo kInfo = {
      .name = "torque_gain",
      .kind = EffectKind::kForce,
      .equation = "T (1 + gain)",
      .sentence = "the motor gives more or less torque than it is told: its torque constant is off",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .scales = BitOf(InputKind::kHipTorque)};

  template <class T>
  static void AddHipTorque(const T* p, const HipMotion<T>& hip, T& torque) {
    torque += p[0] * hip.motor_torque;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect torque_gain = MakeEffect<TorqueGain>();
}
}  // namespace hoplab
