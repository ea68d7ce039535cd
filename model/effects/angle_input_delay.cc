#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct AngleInputDelay {
  static constexpr std::array kParameters = {EffectParameter{"delay", "s", 0.0, -0.1, 0.1, 0.002}};
  static constexpr EffectInfo kInfo = {
      .name = "angle_input_delay",
      .kind = EffectKind::kGuard,
      .equation = "theta_td(t) = theta_log(t - delay)",
      .sentence = "the leg followed its logged angle later, or earlier, than the stamps say",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .needs_inputs = BitsOfFamily(InputKind::kLegAngle),
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.input_delay[static_cast<int>(InputKind::kLegAngle)] += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect angle_input_delay = MakeEffect<AngleInputDelay>();
}
}  // namespace hoplab
