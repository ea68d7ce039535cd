#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct PoseDelay {
  static constexpr std::array kParameters = {EffectParameter{"tau", "s", 0.0, -0.1, 0.1, 0.002}};
  static constexpr EffectInfo kInfo = {
      .name = "pose_delay",
      .kind = EffectKind::kObservation,
      .equation =
          "body_x, body_y, body_pitch and their rates are read at t - tau, the other "
          "channels and contacts at t (M103)",
      .sentence = "what tracks the body reports later, or earlier, than the machine's own sensors",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangePoseTime(const T* p, T& t) {
    t -= p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect pose_delay = MakeEffect<PoseDelay>();
}
}  // namespace hoplab
