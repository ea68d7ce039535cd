#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct TorqueBending {
  static constexpr std::array kParameters = {EffectParameter{"blend", "-", 0.0, -1.0, 2.0, 1.0}};
  static constexpr std::array kLaws = {Law::kThesis, Law::kNoSlip, Law::kConsistent,
                                       Law::kLargeDeflection, Law::kElastica};
  static constexpr std::array kPartOf = {Law::kElastica};  // M120
  static constexpr EffectInfo kInfo = {
      .name = "torque_bending",
      .kind = EffectKind::kParameter,
      .equation =
          "N = T/l bends the leg: l = ... - b N D, u/l = ... - b N B (M24, M25); "
          "elastica: b = 1 of itself (M120)",
      .sentence = "the torque of the hip bends the leg, not only the force along it",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .only_laws = kLaws,
      .part_of = kPartOf};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.law_terms.active = true;
    parameters.law_terms.torque_active = true;
    parameters.law_terms.torque_bending += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect torque_bending = MakeEffect<TorqueBending>();
}
}  // namespace hoplab
