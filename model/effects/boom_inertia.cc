#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct BoomInertia {
  static constexpr std::array kParameters = {EffectParameter{"mu_x", "-", 0.0, 0.0, 10.0, 0.03},
                                             EffectParameter{"mu_y", "-", 0.0, 0.0, 10.0, 0.03}};
  static constexpr EffectInfo kInfo = {
      .name = "boom_inertia",
      .kind = EffectKind::kParameter,
      .equation =
          "inertia m (1 + mu_x) forward, m (1 + mu_y) upward; weight m g; of a robot its body, at "
          "the centre of mass",
      .sentence =
          "something that moves with the body but is carried by the rig, a boom or a carriage, "
          "makes it sluggish without making it heavier",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.inertia_x += p[0];
    parameters.inertia_y += p[1];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect boom_inertia = MakeEffect<BoomInertia>();
}
}  // namespace hoplab
