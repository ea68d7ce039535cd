#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct StiffnessDrift {
  static constexpr std::array kParameters = {
      EffectParameter{"gamma_E", "1/s", 0.0, -0.5, 0.5, 0.005}};
  static constexpr EffectInfo kInfo = {
      .name = "stiffness_drift",
      .kind = EffectKind::kParameter,
      .equation = "E (1 + gamma_E t), t from the first row of the trial; of a robot every leg",
      .sentence = "the leg gets stiffer or softer as time goes on: heating, damage",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    if (parameters.robot) {
      parameters.robot->stiffness_drift += p[0];
      return;
    }
    parameters.law_terms.active = true;
    parameters.law_terms.stiffness_drift += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect stiffness_drift = MakeEffect<StiffnessDrift>();
}
}  // namespace hoplab
