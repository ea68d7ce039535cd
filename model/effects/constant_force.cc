#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct ConstantForce {
  static constexpr std::array kParameters = {
      EffectParameter{"force_x", "N", 0.0, -1000.0, 1000.0, 0.1}};
  static constexpr EffectInfo kInfo = {
      .name = "constant_force",
      .kind = EffectKind::kForce,
      .equation = "F_x = force_x on the body",
      .sentence =
          "something pulls or pushes the body along all the time: a draught, a dragging cable",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void AddBodyForce(const T* p, const BodyMotion<T>&, Vector2<T>& force) {
    force.x += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect constant_force = MakeEffect<ConstantForce>();
}
}  // namespace hoplab
