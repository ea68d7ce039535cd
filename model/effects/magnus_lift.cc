#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct MagnusLift {
  static constexpr std::array kParameters = {
      EffectParameter{"c_m", "N s/m", 0.0, -10.0, 10.0, 0.02}};
  static constexpr EffectInfo kInfo = {
      .name = "magnus_lift",
      .kind = EffectKind::kForce,
      .equation = "F = c_m (-vy, vx) on the ball",
      .sentence = "the ball spins, and the air deflects it at right angles to its way",
      .for_legs = false,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters};

  template <class T>
  static void AddBodyForce(const T* p, const BodyMotion<T>& body, Vector2<T>& force) {
    force.x -= p[0] * body.vy;
    force.y += p[0] * body.vx;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect magnus_lift = MakeEffect<MagnusLift>();
}
}  // namespace hoplab
