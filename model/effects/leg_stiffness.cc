#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct HopperLegStiffness {
  static constexpr std::array kParameters = {EffectParameter{"gain", "-", 0.0, -0.9, 2.0, 0.05}};
  static constexpr EffectInfo kInfo = {.name = "leg_stiffness",
                                       .kind = EffectKind::kParameter,
                                       .equation = "E (1 + gain); k of a straight leg likewise",
                                       .sentence =
                                           "the leg is softer or stiffer than stated, or than in "
                                           "other trials: another leg, a crack, a clamp that gives",
                                       .for_legs = true,
                                       .for_ball = false,
                                       .dissipative = false,
                                       .parameters = kParameters};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    const T share = 1.0 + p[0];
    parameters.E *= share;
    parameters.k *= share;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect leg_stiffness = MakeEffect<HopperLegStiffness>();
}
}  // namespace hoplab
