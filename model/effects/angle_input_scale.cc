#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct AngleInputScale {
  static constexpr std::array kParameters = {EffectParameter{"gain", "-", 0.0, -0.5, 0.5, 0.01}};
  static constexpr EffectInfo kInfo = {
      .name = "angle_input_scale",
      .kind = EffectKind::kGuard,
      .equation = "theta_td = (1 + gain) theta_log",
      .sentence = "the sensor or the drive of the leg angle turns more or less than it says",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .needs_inputs = BitsOfFamily(InputKind::kLegAngle),
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.input_scale[static_cast<int>(InputKind::kLegAngle)] += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect angle_input_scale = MakeEffect<AngleInputScale>();
}
}  // namespace hoplab
