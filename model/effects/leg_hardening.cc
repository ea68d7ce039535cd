#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct LegHardening {
  static constexpr std::array kParameters = {EffectParameter{"beta", "-", 0.0, -1.0, 2.0, 0.2}};
  static constexpr EffectInfo kInfo = {
      .name = "leg_hardening",
      .kind = EffectKind::kParameter,
      .equation =
          "F_el = k delta (1 + beta delta/r); + (beta/r) F^3 C^2/3 in Psi under consistent, "
          "large_deflection (M26)",
      .sentence = "the leg gets stiffer the more it is pressed (softer if negative)",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.law_terms.active = true;
    parameters.law_terms.hardening += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect leg_hardening = MakeEffect<LegHardening>();
}
}  // namespace hoplab
