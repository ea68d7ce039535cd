#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct ForceInputDelay {
  static constexpr std::array kParameters = {EffectParameter{"delay", "s", 0.0, -0.1, 0.1, 0.002}};
  static constexpr EffectInfo kInfo = {
      .name = "force_input_delay",
      .kind = EffectKind::kForce,
      .equation = "F(t) = F_log(t - delay)",
      .sentence = "the logged force pushed the body later, or earlier, than its stamps say",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters,
      .needs_inputs = BitOf(InputKind::kBodyForceX) | BitOf(InputKind::kBodyForceY),
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.input_delay[static_cast<int>(InputKind::kBodyForceX)] += p[0];
    parameters.input_delay[static_cast<int>(InputKind::kBodyForceY)] += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect force_input_delay = MakeEffect<ForceInputDelay>();
}
}  // namespace hoplab
