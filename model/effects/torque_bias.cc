#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct TorqueBias {
  static constexpr std::array kParameters = {
      EffectParameter{"tau_0", "N m", 0.0, -1000.0, 1000.0, 0.02}};
  static constexpr EffectInfo kInfo = {
      .name = "torque_bias",
      .kind = EffectKind::kForce,
      .equation = "T + tau_0 in stance; of a robot tau_0 on every motor, always (M101)",
      .sentence = "a torque is there that nobody asked for: an amplifier offset, a twisted cable",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    if (!parameters.robot) return;
    for (T& bias : parameters.robot->torque_bias) bias += p[0];
  }
  template <class T>
  static void AddHipTorque(const T* p, const HipMotion<T>&, T& torque) {
    torque += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect torque_bias = MakeEffect<TorqueBias>();
}
}  // namespace hoplab
