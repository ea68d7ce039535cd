#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct FootCoulombFriction {
  static constexpr std::array kParameters = {
      EffectParameter{"inverse_mu", "-", 0.0, 0.0, 20.0, 2.0}};
  static constexpr EffectInfo kInfo = {
      .name = "foot_coulomb_friction",
      .kind = EffectKind::kGuard,
      .equation =
          "stance ends where |u|/Y > mu, mu = 1/inverse_mu (M64); with leg_mass the foot slides "
          "(M87)",
      .sentence =
          "the ground is slippery: the foot slides where it is pushed more sideways than friction "
          "holds",
      .for_legs = true,
      .for_ball = false,
      .dissipative = true,
      .has_threshold = true,
      .shows_beside = "leg_mass",
      .massless_leg_only = true,
      .parameters = kParameters};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.law_terms.foot_friction_active = true;
    parameters.law_terms.foot_friction += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect foot_coulomb_friction = MakeEffect<FootCoulombFriction>();
}
}  // namespace hoplab
