#include <array>
#include <numbers>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

constexpr double kAir = 1.2;  // kg/m^3

struct DisplacedAir {
  static constexpr std::array kParameters = {EffectParameter{.name = "density",
                                                             .unit = "-",
                                                             .null = 0.0,
                                                             .lower = 0.0,
                                                             .upper = 2.0,
                                                             .typical = 1.0,
                                                             .known_share = 0.1}};
  static constexpr EffectInfo kInfo = {
      .name = "displaced_air",
      .kind = EffectKind::kParameter,
      .equation =
          "(m + 3/2 m_a) dv/dt = F - m g, m as weighed in air, m_a = density 1.2 kg/m^3 4/3 pi "
          "radius^3",
      .sentence = "the air that a light ball displaces carries it a little and moves along with it",
      .for_legs = false,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    const T& r = parameters.radius;
    const T share = p[0] * (kAir * 4.0 / 3.0 * std::numbers::pi) * (r * r * r) / parameters.m;
    const T inertia = 1.0 + 1.5 * share;
    parameters.m *= inertia;
    parameters.g /= inertia;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect displaced_air = MakeEffect<DisplacedAir>();
}
}  // namespace hoplab
