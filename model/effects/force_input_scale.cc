#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct ForceInputScale {
  static constexpr std::array kParameters = {EffectParameter{"gain", "-", 0.0, -0.9, 5.0, 0.05}};
  static constexpr EffectInfo kInfo = {
      .name = "force_input_scale",
      .kind = EffectKind::kForce,
      .equation = "F = (1 + gain) F_log",
      .sentence = "the logged force was larger or smaller than its sensor says",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters,
      .needs_inputs = BitOf(InputKind::kBodyForceX) | BitOf(InputKind::kBodyForceY),
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.input_scale[static_cast<int>(InputKind::kBodyForceX)] += p[0];
    parameters.input_scale[static_cast<int>(InputKind::kBodyForceY)] += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect force_input_scale = MakeEffect<ForceInputScale>();
}
}  // namespace hoplab
