#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct FootSlip {
  static constexpr std::array kParameters = {
      EffectParameter{"c_slip", "m/(N s)", 0.0, 0.0, 0.1, 5e-4}};
  static constexpr EffectInfo kInfo = {
      .name = "foot_slip",
      .kind = EffectKind::kParameter,
      .equation =
          "dx_c/dt gets -c_slip F_x, F_x the horizontal force on the hip (M29), of a robot "
          "that of each leg whose foot holds",
      .sentence = "the foot creeps over the ground against the force on it",
      .for_legs = true,
      .for_ball = false,
      .dissipative = true,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    if (parameters.robot) {
      parameters.robot->foot_slip += p[0];
      return;
    }
    parameters.law_terms.active = true;
    parameters.law_terms.foot_slip += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect foot_slip = MakeEffect<FootSlip>();
}
}  // namespace hoplab
