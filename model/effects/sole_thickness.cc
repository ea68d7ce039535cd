#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SoleThickness {
  static constexpr std::array kParameters = {EffectParameter{"h_sole", "m", 0.0, 0.0, 0.1, 1e-3}};
  static constexpr std::array kLaws = {Law::kConsistent, Law::kLargeDeflection, Law::kElastica};
  static constexpr EffectInfo kInfo = {
      .name = "sole_thickness",
      .kind = EffectKind::kParameter,
      .equation =
          "the leg stands and rolls on a circle of r + h_sole and bends along one of r (M113)",
      .sentence =
          "the leg stands on a sole, or on its own outside: the ground lies further from its "
          "middle line, which bends, than the model has it",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .massless_leg_only = true,
      .parameters = kParameters,
      .only_laws = kLaws};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.law_terms.active = true;
    parameters.law_terms.sole_active = true;
    parameters.law_terms.sole += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect sole_thickness = MakeEffect<SoleThickness>();
}
}  // namespace hoplab
