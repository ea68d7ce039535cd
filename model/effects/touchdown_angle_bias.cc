#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct TouchdownAngleBias {
  static constexpr std::array kParameters = {
      EffectParameter{"dtheta", "rad", 0.0, -0.5, 0.5, 0.02}};
  static constexpr EffectInfo kInfo = {
      .name = "touchdown_angle_bias",
      .kind = EffectKind::kGuard,
      .equation = "theta_td + dtheta in the touch-down guard and reset",
      .sentence = "the leg touches down at another angle than commanded: servo or encoder offset",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters};

  template <class T>
  static void ChangeTouchdownAngle(const T* p, const T&, T& theta_td) {
    theta_td += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect touchdown_angle_bias = MakeEffect<TouchdownAngleBias>();
}
}  // namespace hoplab
