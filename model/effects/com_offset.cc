#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct ComOffset {
  static constexpr std::array kParameters = {EffectParameter{"dx", "m", 0.0, -0.5, 0.5, 0.005},
                                             EffectParameter{"dy", "m", 0.0, -0.5, 0.5, 0.005}};
  static constexpr EffectInfo kInfo = {
      .name = "com_offset",
      .kind = EffectKind::kParameter,
      .equation = "centre of mass at c + (dx, dy) in the body frame",
      .sentence = "the robot's mass sits ahead of, behind, above or below where it was stated",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->com_x += p[0];
    parameters.robot->com_y += p[1];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect com_offset = MakeEffect<ComOffset>();
}
}  // namespace hoplab
