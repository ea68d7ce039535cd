#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct UnevenCurvature {
  static constexpr std::array kParameters = {EffectParameter{"chi", "-", 0.0, -0.5, 0.5, 0.02}};
  static constexpr std::array kLaws = {Law::kConsistent, Law::kLargeDeflection, Law::kElastica};
  static constexpr EffectInfo kInfo = {
      .name = "uneven_curvature",
      .kind = EffectKind::kParameter,
      .equation = "rest curvature (1 + chi (1 - 2 s/(pi r)))/r at the length s from the hub (M124)",
      .sentence =
          "the unloaded leg is no circle: it is more curved towards its hub than towards its toe, "
          "or less",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .massless_leg_only = true,
      .parameters = kParameters,
      .only_laws = kLaws};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.law_terms.active = true;
    parameters.law_terms.uneven_active = true;
    parameters.law_terms.uneven += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect uneven_curvature = MakeEffect<UnevenCurvature>();
}
}  // namespace hoplab
