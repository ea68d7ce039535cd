#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct BodyMassScale {
  static constexpr std::array kParameters = {EffectParameter{"mu_m", "-", 0.0, -0.5, 5.0, 0.02}};
  static constexpr EffectInfo kInfo = {
      .name = "body_mass_scale",
      .kind = EffectKind::kParameter,
      .equation = "m (1 + mu_m), weight included",
      .sentence = "the body weighs more or less than stated: a battery, a cable, a wrong scale",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.m *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect body_mass_scale = MakeEffect<BodyMassScale>();
}
}  // namespace hoplab
