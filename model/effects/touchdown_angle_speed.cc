#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct TouchdownAngleSpeed {
  static constexpr std::array kParameters = {
      EffectParameter{"kappa", "rad s/m", 0.0, -1.0, 1.0, 0.02}};
  static constexpr EffectInfo kInfo = {
      .name = "touchdown_angle_speed",
      .kind = EffectKind::kGuard,
      .equation = "theta_td + kappa (vx - 1 m/s) in the touch-down guard and reset",
      .sentence =
          "the leg is placed further ahead, or less far, the faster the body goes: foot placement, "
          "or a servo that air drag pushes back",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters};
  static constexpr double kReferenceSpeed = 1.0;  // m/s

  template <class T>
  static void ChangeTouchdownAngle(const T* p, const T& vx, T& theta_td) {
    theta_td += p[0] * (vx - kReferenceSpeed);
  }
};

}  // namespace

namespace effects {
extern constexpr Effect touchdown_angle_speed = MakeEffect<TouchdownAngleSpeed>();
}
}  // namespace hoplab
