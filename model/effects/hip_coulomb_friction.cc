#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

// Rate within which dry friction of a hopper's hip turns round (M38) [rad/s].
constexpr double kHipFrictionWidth = 0.5;

struct HipCoulombFriction {
  static constexpr std::array kParameters = {
      EffectParameter{"tau_c", "N m", 0.0, 0.0, 1000.0, 0.03}};
  static constexpr EffectInfo kInfo = {
      .name = "hip_coulomb_friction",
      .kind = EffectKind::kForce,
      .equation =
          "T + tau_c tanh((dtheta/dt)/(0.5 rad/s)) in stance, theta the leg angle (M38, M93); of a "
          "robot tau_c sign(dpsi/dt), which holds a hip at rest (M99)",
      .sentence =
          "the hip bearing or gear rubs with a torque that only asks which way the leg turns",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,  // of the hop: the joint only takes (M38, M94)
      .sharp = true,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    if (parameters.robot) {
      for (T& c : parameters.robot->hip_coulomb) c += p[0];
      return;
    }
    parameters.law_terms.active = parameters.law_terms.slopes_active = true;
  }
  template <class T>
  static void AddJointTorque(const T* p, const JointMotion<T>& joint, T& torque) {
    using std::tanh;
    torque += p[0] * tanh(joint.rate / kHipFrictionWidth);
  }
};

}  // namespace

namespace effects {
extern constexpr Effect hip_coulomb_friction = MakeEffect<HipCoulombFriction>();
}
}  // namespace hoplab
