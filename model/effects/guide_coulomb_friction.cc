#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct GuideCoulombFriction {
  static constexpr std::array kParameters = {EffectParameter{"f_c", "N", 0.0, 0.0, 1000.0, 0.1}};
  static constexpr EffectInfo kInfo = {
      .name = "guide_coulomb_friction",
      .kind = EffectKind::kForce,
      .equation = "F_y = -f_c tanh(vy/(0.02 m/s)) on the body",
      .sentence = "the vertical guide rubs with a force that only asks which way the body moves",
      .for_legs = true,
      .for_ball = true,
      .dissipative = true,
      .sharp = true,
      .parameters = kParameters,
      .for_robot = true,
      .about = MachinePart::kGuideOfBall};
  static constexpr double kWidth = 0.02;  // m/s

  template <class T>
  static void AddBodyForce(const T* p, const BodyMotion<T>& body, Vector2<T>& force) {
    using std::tanh;
    force.y -= p[0] * tanh(body.vy / kWidth);
  }
};

}  // namespace

namespace effects {
extern constexpr Effect guide_coulomb_friction = MakeEffect<GuideCoulombFriction>();
}
}  // namespace hoplab
