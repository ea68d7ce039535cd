#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct TipRotation {
  static constexpr std::array kParameters = {EffectParameter{"blend", "-", 0.0, -1.0, 2.0, 1.0}};
  static constexpr std::array kLaws = {Law::kThesis, Law::kNoSlip};
  static constexpr EffectInfo kInfo = {
      .name = "tip_rotation",
      .kind = EffectKind::kParameter,
      .equation =
          "u/l = cos(phi/2) - t F C'/2, stiffness radius (1 - t) r_d + t r, damping rate (1 - t) "
          "dl/dt + t w",
      .sentence =
          "the loaded end of the leg turns, so that the leg touches the ground at another arc than "
          "a half circle would",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .only_laws = kLaws};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.law_terms.active = true;
    parameters.law_terms.tip += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect tip_rotation = MakeEffect<TipRotation>();
}
}  // namespace hoplab
