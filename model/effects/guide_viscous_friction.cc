#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct GuideViscousFriction {
  static constexpr std::array kParameters = {
      EffectParameter{"b_g", "N s/m", 0.0, 0.0, 1000.0, 0.1}};
  static constexpr EffectInfo kInfo = {
      .name = "guide_viscous_friction",
      .kind = EffectKind::kForce,
      .equation = "F_y = -b_g vy on the body",
      .sentence = "grease in the vertical guide resists in proportion to speed",
      .for_legs = true,
      .for_ball = true,
      .dissipative = true,
      .parameters = kParameters,
      .for_robot = true,
      .about = MachinePart::kGuideOfBall};

  template <class T>
  static void AddBodyForce(const T* p, const BodyMotion<T>& body, Vector2<T>& force) {
    force.y -= p[0] * body.vy;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect guide_viscous_friction = MakeEffect<GuideViscousFriction>();
}
}  // namespace hoplab
