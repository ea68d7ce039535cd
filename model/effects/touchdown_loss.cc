#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct TouchdownLoss {
  static constexpr std::array kParameters = {EffectParameter{"zeta", "-", 0.0, 0.0, 1.0, 0.01}};
  static constexpr EffectInfo kInfo = {
      .name = "touchdown_loss",
      .kind = EffectKind::kGuard,
      .equation = "v+ = v- - zeta (v- . e) e at touch-down",
      .sentence = "the impact takes some of the speed along the leg: unsprung mass",
      .for_legs = true,
      .for_ball = false,
      .dissipative = true,
      .parameters = kParameters};

  template <class T>
  static void ChangeLandingVelocity(const T* p, const Landing<T>& landing, Vector2<T>& velocity) {
    const T along = velocity.x * landing.chord.x + velocity.y * landing.chord.y;
    velocity.x -= p[0] * along * landing.chord.x;
    velocity.y -= p[0] * along * landing.chord.y;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect touchdown_loss = MakeEffect<TouchdownLoss>();
}
}  // namespace hoplab
