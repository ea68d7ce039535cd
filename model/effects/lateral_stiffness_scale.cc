#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct LateralStiffnessScale {
  static constexpr std::array kParameters = {EffectParameter{"gamma", "-", 0.0, -0.9, 20.0, 0.1}};
  static constexpr EffectInfo kInfo = {
      .name = "lateral_stiffness_scale",
      .kind = EffectKind::kParameter,
      .equation = "k_lateral (1 + gamma) of every leg",
      .sentence = "straight legs are stiffer or softer across than stated",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true,
      .rods_only = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->lateral_stiffness *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect lateral_stiffness_scale = MakeEffect<LateralStiffnessScale>();
}
}  // namespace hoplab
