#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct RestitutionSpeed {
  static constexpr std::array kParameters = {EffectParameter{"slope", "s/m", 0.0, -0.5, 0.5, 0.01}};
  static constexpr EffectInfo kInfo = {
      .name = "restitution_speed",
      .kind = EffectKind::kGuard,
      .equation = "restitution + slope |vy-| at a bounce",
      .sentence = "harder impacts are returned less well, or better, than gentle ones",
      .for_legs = false,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters};

  template <class T>
  static void ChangeRestitution(const T* p, const T& speed, T& restitution) {
    restitution += p[0] * speed;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect restitution_speed = MakeEffect<RestitutionSpeed>();
}
}  // namespace hoplab
