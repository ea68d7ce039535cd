#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct CameraRoll {
  static constexpr std::array kParameters = {EffectParameter{"roll", "rad", 0.0, -0.5, 0.5, 0.005}};
  static constexpr EffectInfo kInfo = {
      .name = "camera_roll",
      .kind = EffectKind::kObservation,
      .equation = "measured (x, y) and (vx, vy) turned about the origin by roll",
      .sentence = "the camera hangs askew, so that its picture is turned",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .order = 5,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeObservation(const T* p, Observation<T>& seen) {
    using std::cos;
    using std::sin;
    const T c = cos(p[0]), s = sin(p[0]);
    const auto turn = [&](T& x, T& y) {
      const T turned = c * x - s * y;
      y = s * x + c * y;
      x = turned;
    };
    turn(seen[Channel::kBodyX], seen[Channel::kBodyY]);
    turn(seen[Channel::kBodyVx], seen[Channel::kBodyVy]);
  }
};

}  // namespace

namespace effects {
extern constexpr Effect camera_roll = MakeEffect<CameraRoll>();
}
}  // namespace hoplab
