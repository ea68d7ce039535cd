#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct GroundSlope {
  static constexpr std::array kParameters = {EffectParameter{"slope", "rad", 0.0, -0.7, 0.7, 0.01}};
  static constexpr EffectInfo kInfo = {
      .name = "ground_slope",
      .kind = EffectKind::kParameter,
      .equation = "ground y = x tan(slope), gravity vertical, leg angles from the horizontal",
      .sentence = "the ground is not level: it rises (or falls) ahead of the body",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.slope += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect ground_slope = MakeEffect<GroundSlope>();
}
}  // namespace hoplab
