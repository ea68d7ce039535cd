#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct HubClamp {
  static constexpr std::array kParameters = {EffectParameter{
      "length", "m", 0.0, 0.0, 0.05, 0.003, /*is_shape=*/false, ParameterId::kClamp}};
  static constexpr EffectInfo kInfo = {
      .name = "hub_clamp",
      .kind = EffectKind::kParameter,
      .equation =
          "clamp + length of every leg (M77); a fit takes nine tenths of the stated one at "
          "most",
      .sentence =
          "the hubs hold a longer, or a shorter, piece of the robot's legs rigid than stated",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true,
      .arcs_only = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->clamp += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect hub_clamp = MakeEffect<HubClamp>();
}
}  // namespace hoplab
