#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct GaitSweepScale {
  static constexpr std::array kParameters = {EffectParameter{"gamma", "-", 0.0, -0.5, 0.5, 0.05}};
  static constexpr EffectInfo kInfo = {
      .name = "gait_sweep_scale",
      .kind = EffectKind::kParameter,
      .equation = "sweep (1 + gamma) in M76 (M110)",
      .sentence = "the legs swing through a larger, or a smaller, angle on the ground than stated",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true,
      .about = MachinePart::kClock};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->sweep *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect gait_sweep_scale = MakeEffect<GaitSweepScale>();
}
}  // namespace hoplab
