#include <array>
#include <cmath>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

// What turns a hollow ball that slides into one that rolls, as a share of its speed: I/(m r^2) is
// 2/3, M104.
constexpr double kRollingShare = 0.4;

struct BounceCoulombFriction {
  static constexpr std::array kParameters = {EffectParameter{"mu", "-", 0.0, -1.0, 2.0, 0.2}};
  static constexpr EffectInfo kInfo = {
      .name = "bounce_coulomb_friction",
      .kind = EffectKind::kGuard,
      .equation =
          "vx+ - mu (1 + restitution) |vy-| sign(vx-) at a bounce, 0.4 |vx-| at most (M104)",
      .sentence =
          "the ground drags on the ball while it bounces, as hard as it is pressed; a "
          "spin makes it less, or pushes it on",
      .for_legs = false,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters};

  template <class T>
  static void ChangeBounceSpeed(const T* p, const Bounce<T>& bounce, T& vx) {
    const T push = p[0] * (bounce.leaving_vy - bounce.arriving.y);
    const T most = kRollingShare * bounce.arriving.x;
    const bool rolls = std::abs(Value(push)) >= std::abs(Value(most));
    if (rolls)
      vx -= Value(p[0]) < 0.0 ? T(-most) : most;
    else
      vx -= Value(bounce.arriving.x) < 0.0 ? T(-push) : push;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect bounce_coulomb_friction = MakeEffect<BounceCoulombFriction>();
}
}  // namespace hoplab
