#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct GroundCompliance {
  static constexpr std::array kParameters = {EffectParameter{"c_g", "m/N", 0.0, 0.0, 1e-3, 1e-5}};
  static constexpr EffectInfo kInfo = {
      .name = "ground_compliance",
      .kind = EffectKind::kParameter,
      .equation = "the ground sinks by c_g F_el e_y under the foot (M28), of a robot under each",
      .sentence = "the ground gives way elastically under the foot",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true,
      .arcs_only = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    if (parameters.robot) {
      parameters.robot->ground_compliance += p[0];
      return;
    }
    parameters.law_terms.active = true;
    parameters.law_terms.ground_compliance += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect ground_compliance = MakeEffect<GroundCompliance>();
}
}  // namespace hoplab
