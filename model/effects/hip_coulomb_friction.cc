#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct HipCoulombFriction {
  static constexpr std::array kParameters = {
      EffectParameter{"tau_c", "N m", 0.0, 0.0, 1000.0, 0.03}};
  static constexpr EffectInfo kInfo = {
      .name = "hip_coulomb_friction",
      .kind = EffectKind::kForce,
      .equation = "T + tau_c tanh((dtheta/dt)/(0.5 rad/s)) in stance",
      .sentence =
          "the hip bearing or gear rubs with a torque that only asks which way the leg turns",
      .for_legs = true,
      .for_ball = false,
      .dissipative = true,
      .sharp = true,
      .parameters = kParameters};
  static constexpr double kWidth = 0.5;  // rad/s

  template <class T>
  static void AddHipTorque(const T* p, const HipMotion<T>& hip, T& torque) {
    using std::tanh;
    torque += p[0] * tanh(hip.rate / kWidth);  // forward is falling theta
  }
};

}  // namespace

namespace effects {
extern constexpr Effect hip_coulomb_friction = MakeEffect<HipCoulombFriction>();
}
}  // namespace hoplab
