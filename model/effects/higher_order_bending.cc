#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct HigherOrderBending {
  static constexpr std::array kParameters = {EffectParameter{"share", "-", 0.0, -1.0, 2.0, 1.0}};
  static constexpr std::array kLaws = {Law::kLargeDeflection};
  static constexpr EffectInfo kInfo = {
      .name = "higher_order_bending",
      .kind = EffectKind::kParameter,
      .equation = "Psi less share of what the elastica has beyond C2 (M65)",
      .sentence =
          "the leg bends so far that even the second term of its bending is not enough: the rest "
          "of the exact elastica",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .only_laws = kLaws};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.law_terms.active = parameters.law_terms.higher_order_active = true;
    parameters.law_terms.higher_order += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect higher_order_bending = MakeEffect<HigherOrderBending>();
}
}  // namespace hoplab
