#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct LegsOwnMass {
  static constexpr std::array kParameters = {EffectParameter{"m_leg", "kg", 0.0, 0.0, 10.0, 0.02}};
  static constexpr EffectInfo kInfo = {
      .name = "leg_mass",
      .kind = EffectKind::kParameter,
      .equation =
          "(diag(m - m_leg) + M_leg) dv/dt in stance, impact at touch-down, swing (M56-M60, M88)",
      .sentence =
          "part of the weighed mass is the leg's own, spread along it: it lands with a blow, "
          "follows the hip in stance and swings forward in flight",
      .for_legs = true,
      .for_ball = false,
      .dissipative = true,
      .massless_leg_only = true,
      .parameters = kParameters};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    LawTerms<T>& terms = parameters.law_terms;
    terms.active = terms.slopes_active = terms.leg_mass_active = true;
    terms.leg_mass += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect leg_mass = MakeEffect<LegsOwnMass>();
}
}  // namespace hoplab
