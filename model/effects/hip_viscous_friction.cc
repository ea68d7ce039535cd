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
      .equation = "T + b_h dtheta/dt in stance, theta the leg angle (M38, M93); of a robot M99",
      .sentence = "the hip bearing resists turning in proportion to its speed",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,  // of the hop: the joint only takes (M38, M94)
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    if (parameters.robot) {
      for (T& b : parameters.robot->hip_viscous) b += p[0];
      return;
    }
    parameters.law_terms.active = parameters.law_terms.slopes_active = true;
  }
  template <class T>
  static void AddJointTorque(const T* p, const JointMotion<T>& joint, T& torque) {
    torque += p[0] * joint.rate;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect hip_viscous_friction = MakeEffect<HipViscousFriction>();
}
}  // namespace hoplab
