#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct AirDrag {
  static constexpr std::array kParameters = {
      EffectParameter{"c_drag", "N s^2/m^2", 0.0, 0.0, 10.0, 0.02}};
  static constexpr EffectInfo kInfo = {
      .name = "air_drag",
      .kind = EffectKind::kForce,
      .equation = "F = -c_drag |v| v on the body",
      .sentence = "air slows the body with the square of its speed",
      .for_legs = true,
      .for_ball = true,
      .dissipative = true,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void AddBodyForce(const T* p, const BodyMotion<T>& body, Vector2<T>& force) {
    using std::sqrt;
    const T speed_squared = body.vx * body.vx + body.vy * body.vy;
    if (Value(speed_squared) == 0.0) return;  // |v| v and its derivatives vanish there
    const T factor = p[0] * sqrt(speed_squared);
    force.x -= factor * body.vx;
    force.y -= factor * body.vy;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect air_drag = MakeEffect<AirDrag>();
}
}  // namespace hoplab
