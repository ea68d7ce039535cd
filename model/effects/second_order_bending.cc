#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SecondOrderBending {
  static constexpr std::array kParameters = {EffectParameter{"blend", "-", 0.0, -1.0, 2.0, 1.0}};
  static constexpr std::array kLaws = {Law::kThesis, Law::kNoSlip, Law::kConsistent};
  static constexpr EffectInfo kInfo = {
      .name = "second_order_bending",
      .kind = EffectKind::kParameter,
      .equation = "A2 = b C2 - (beta/r) C^2 in M9b and M10b, C2 of M2b (M26)",
      .sentence =
          "the leg bends so far that it gets softer under load: the next term of the exact "
          "elastica",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .only_laws = kLaws};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.law_terms.active = true;
    parameters.law_terms.second_order_active = true;
    parameters.law_terms.second_order += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect second_order_bending = MakeEffect<SecondOrderBending>();
}
}  // namespace hoplab
