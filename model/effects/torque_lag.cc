#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct TorqueLag {
  static constexpr std::array kParameters = {EffectParameter{"t_lag", "s", 0.0, 0.0, 0.5, 0.005}};
  static constexpr EffectInfo kInfo = {
      .name = "torque_lag",
      .kind = EffectKind::kForce,
      .equation = "t_lag dT/dt = T_cmd - T, T = T_cmd at touch-down",
      .sentence = "the motor follows its command only after a while: winding, filter, gear play",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .massless_leg_only = true,
      .parameters = kParameters};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.torque_lag += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect torque_lag = MakeEffect<TorqueLag>();
}
}  // namespace hoplab
