#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct Wind {
  static constexpr std::array kParameters = {
      EffectParameter{"c_wind", "N s/m", 0.0, -10.0, 10.0, 0.02},
      EffectParameter{.name = "w",
                      .unit = "m/s",
                      .null = 0.0,
                      .lower = -40.0,
                      .upper = 40.0,
                      .typical = 1.0,
                      .is_of_first = true}};
  static constexpr EffectInfo kInfo = {
      .name = "wind",
      .kind = EffectKind::kForce,
      .equation = "F = c_wind (|v| v - |u| u)/w on the ball, u = v - (w, 0), c_wind = c_drag w",
      .sentence = "the air moves along the ground, so the ball's drag pulls it along",
      .for_legs = false,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters,
      .about = MachinePart::kTwoAxes};

  template <class T>
  static void AddBodyForce(const T* p, const BodyMotion<T>& body, Vector2<T>& force) {
    using std::sqrt;
    const T ux = body.vx - p[1];
    const T seen = body.vx * body.vx + body.vy * body.vy, felt = ux * ux + body.vy * body.vy;
    if (Value(seen) + Value(felt) == 0.0) return;
    // At one instant at most; |v| has no derivative there.
    const T speed = Value(seen) == 0.0 ? T(0.0) : sqrt(seen);
    const T of_air = Value(felt) == 0.0 ? T(0.0) : sqrt(felt);
    const T factor = p[0] * (2.0 * body.vx - p[1]) / (speed + of_air);
    force.x += p[0] * speed + factor * ux;
    force.y += factor * body.vy;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect wind = MakeEffect<Wind>();
}
}  // namespace hoplab
