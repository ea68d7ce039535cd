#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct RotorInertiaScale {
  static constexpr std::array kParameters = {EffectParameter{"gamma", "-", 0.0, -0.9, 20.0, 0.1}};
  static constexpr EffectInfo kInfo = {
      .name = "rotor_inertia_scale",
      .kind = EffectKind::kParameter,
      .equation = "J (1 + gamma) of every motor (M107)",
      .sentence =
          "what the motors turn is heavier or lighter than stated: a rotor behind its gear, a hub",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->rotor_inertia *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect rotor_inertia_scale = MakeEffect<RotorInertiaScale>();
}
}  // namespace hoplab
