#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct PitchInertiaScale {
  static constexpr std::array kParameters = {EffectParameter{"gamma", "-", 0.0, -0.9, 5.0, 0.05}};
  static constexpr EffectInfo kInfo = {
      .name = "pitch_inertia_scale",
      .kind = EffectKind::kParameter,
      .equation = "I (1 + gamma), about the centre of mass",
      .sentence = "the robot's body turns more or less readily than stated",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->pitch_inertia *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect pitch_inertia_scale = MakeEffect<PitchInertiaScale>();
}
}  // namespace hoplab
