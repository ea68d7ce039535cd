#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SwingingLegMass {
  static constexpr std::array kParameters = {EffectParameter{
      "m_leg", "kg", 0.0, 0.0, 10.0, 0.005, /*is_shape=*/false, ParameterId::kLegMass}};
  static constexpr EffectInfo kInfo = {
      .name = "swinging_leg_mass",
      .kind = EffectKind::kParameter,
      .equation =
          "leg_mass + m_leg of every leg (M82); a fit takes nine tenths of the stated mass at most",
      .sentence =
          "the robot's legs are heavier or lighter than stated: the body turns as they swing, and "
          "the motors turn them less or more readily",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->leg_mass += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect swinging_leg_mass = MakeEffect<SwingingLegMass>();
}
}  // namespace hoplab
