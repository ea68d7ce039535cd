#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct RestLengthScale {
  static constexpr std::array kParameters = {EffectParameter{"rho_l", "-", 0.0, -0.5, 1.0, 0.01}};
  static constexpr std::array kLaws = {Law::kStraightLeg};
  static constexpr EffectInfo kInfo = {.name = "rest_length_scale",
                                       .kind = EffectKind::kParameter,
                                       .equation = "l0 (1 + rho_l)",
                                       .sentence =
                                           "the unloaded leg is longer or shorter than stated: a "
                                           "spring that has set, or a length that "
                                           "was measured to the wrong point",
                                       .for_legs = true,
                                       .for_ball = false,
                                       .dissipative = false,
                                       .parameters = kParameters,
                                       .only_laws = kLaws,
                                       .for_robot = true,
                                       .rods_only = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.l0 *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect rest_length_scale = MakeEffect<RestLengthScale>();
}
}  // namespace hoplab
