#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct CameraScale {
  static constexpr std::array kParameters = {EffectParameter{"gain", "-", 0.0, -0.5, 0.5, 0.01}};
  static constexpr EffectInfo kInfo = {
      .name = "camera_scale",
      .kind = EffectKind::kObservation,
      .equation = "measured (x, y) and (vx, vy) times 1 + gain",
      .sentence =
          "the camera's pixels per metre are off, so that its picture is too large or too small",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .order = 6,
      .parameters = kParameters,
      .for_robot = true,
      .about = MachinePart::kTwoAxes};

  template <class T>
  static void ChangeObservation(const T* p, Observation<T>& seen) {
    const T scale = 1.0 + p[0];
    for (const Channel channel :
         {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVx, Channel::kBodyVy})
      seen[channel] *= scale;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect camera_scale = MakeEffect<CameraScale>();
}
}  // namespace hoplab
