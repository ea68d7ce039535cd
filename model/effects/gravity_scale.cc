#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct GravityScale {
  static constexpr std::array kParameters = {EffectParameter{"gamma", "-", 0.0, -0.9, 1.0, 0.005}};
  static constexpr EffectInfo kInfo = {
      .name = "gravity_scale",
      .kind = EffectKind::kParameter,
      .equation = "g (1 + gamma)",
      .sentence = "the body feels more or less gravity than stated, as on a boom or counterweight",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.g *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect gravity_scale = MakeEffect<GravityScale>();
}
}  // namespace hoplab
