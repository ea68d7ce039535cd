#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct RollingLaw {
  static constexpr std::array kParameters = {EffectParameter{"blend", "-", 0.0, -1.0, 2.0, 1.0}};
  static constexpr std::array kLaws = {Law::kThesis, Law::kNoSlip, Law::kConsistent,
                                       Law::kLargeDeflection, Law::kElastica};
  static constexpr EffectInfo kInfo = {
      .name = "rolling_law",
      .kind = EffectKind::kParameter,
      .equation =
          "dx_c/dt = (1 - b) of the law's own rolling + b of the other: r dphi/dt against r_d "
          "sin(theta) dphi/dt (M27)",
      .sentence =
          "the contact advances along the ground by the other rule: by the arc laid down, or by "
          "what the thesis has instead",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .only_laws = kLaws};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.law_terms.active = true;
    parameters.law_terms.rolling_active = true;
    parameters.law_terms.rolling += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect rolling_law = MakeEffect<RollingLaw>();
}
}  // namespace hoplab
