#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct TorqueInputDelay {
  static constexpr std::array kParameters = {EffectParameter{"delay", "s", 0.0, -0.1, 0.1, 0.002}};
  static constexpr EffectInfo kInfo = {
      .name = "torque_input_delay",
      .kind = EffectKind::kForce,
      .equation = "T(t) = T_log(t - delay)",
      .sentence = "the logged torque reached the leg later, or earlier, than its stamps say",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .needs_inputs = BitsOfFamily(InputKind::kHipTorque),
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.input_delay[static_cast<int>(InputKind::kHipTorque)] += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect torque_input_delay = MakeEffect<TorqueInputDelay>();
}
}  // namespace hoplab
