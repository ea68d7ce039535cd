#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct RestLengthStep {
  static constexpr std::array kParameters = {EffectParameter{"dl", "m", 0.0, 0.0, 1.0, 0.003}};
  static constexpr std::array kLaws = {Law::kStraightLeg};
  static constexpr EffectInfo kInfo = {
      .name = "rest_length_step",
      .kind = EffectKind::kParameter,
      .equation = "l0 + dl from greatest compression to lift-off",
      .sentence = "the leg pushes: at its shortest it makes itself a little longer",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .massless_leg_only = true,
      .parameters = kParameters,
      .only_laws = kLaws};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.rest_length_step += p[0];
    parameters.has_rest_length_step = true;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect rest_length_step = MakeEffect<RestLengthStep>();
}
}  // namespace hoplab
