#include <array>
#include <cmath>

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
          "(M87); of a robot 1/mu = 1/(stated mu) + inverse_mu (M69)",
      .sentence =
          "the ground is slippery: the foot slides where it is pushed more sideways than friction "
          "holds",
      .for_legs = true,
      .for_ball = false,
      .dissipative = true,
      .has_threshold = true,
      .shows_beside = "leg_mass",
      .massless_leg_only = true,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    if (parameters.robot) return MakeSlippery(p[0], parameters.robot->friction);
    parameters.law_terms.foot_friction_active = true;
    parameters.law_terms.foot_friction += p[0];
  }

 private:
  // A ground that holds, whatever the load, has no finite friction to be differentiated.
  template <class T>
  static void MakeSlippery(const T& inverse_mu, T& friction) {
    if (std::isfinite(Value(friction)))
      friction = friction / (1.0 + friction * inverse_mu);
    else if (Value(inverse_mu) > 0.0)
      friction = 1.0 / inverse_mu;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect foot_coulomb_friction = MakeEffect<FootCoulombFriction>();
}
}  // namespace hoplab
