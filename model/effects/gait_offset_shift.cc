#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct GaitOffsetShift {
  static constexpr std::array kParameters = {EffectParameter{"shift", "rad", 0.0, -1.0, 1.0, 0.05}};
  static constexpr EffectInfo kInfo = {
      .name = "gait_offset_shift",
      .kind = EffectKind::kParameter,
      .equation = "offset + shift in M76 (M110)",
      .sentence = "the middle of the angle that the legs swing through lies elsewhere than stated",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true,
      .about = MachinePart::kClock};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->offset += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect gait_offset_shift = MakeEffect<GaitOffsetShift>();
}
}  // namespace hoplab
