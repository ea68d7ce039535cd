#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct HipViscousFriction {
  static constexpr std::array kParameters = {
      EffectParameter{"b_h", "N m s/rad", 0.0, 0.0, 100.0, 0.005}};
  static constexpr EffectInfo kInfo = {
      .name = "hip_viscous_friction",
      .kind = EffectKind::kForce,
      .equation = "T + b_h dtheta/dt in stance",
      .sentence = "the hip bearing resists turning in proportion to its speed",
      .for_legs = true,
      .for_ball = false,
      .dissipative = true,
      .parameters = kParameters};

  template <class T>
  static void AddHipTorque(const T* p, const HipMotion<T>& hip, T& torque) {
    torque += p[0] * hip.rate;  // forward is falling theta
  }
};

}  // namespace

namespace effects {
extern constexpr Effect hip_viscous_friction = MakeEffect<HipViscousFriction>();
}
}  // namespace hoplab
