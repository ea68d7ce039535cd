#include <array>
#include <cmath>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct MarkerOffset {
  static constexpr std::array kParameters = {EffectParameter{"dx", "m", 0.0, -0.5, 0.5, 0.005},
                                             EffectParameter{"dy", "m", 0.0, -0.5, 0.5, 0.005}};
  static constexpr EffectInfo kInfo = {
      .name = "marker_offset",
      .kind = EffectKind::kObservation,
      .equation = "what is tracked sits at (dx, dy) in the body frame (M102)",
      .sentence =
          "the marker sits elsewhere on the body than at its reference point, and moves "
          "with its pitch",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .order = 2,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeObservation(const T* p, Observation<T>& seen) {
    using std::cos;
    using std::sin;
    if (!seen.Has(Channel::kBodyPitch)) return;
    const T &pitch = seen[Channel::kBodyPitch], &rate = seen.pitch_rate;
    const T c = cos(pitch), s = sin(pitch);
    const T across = c * p[0] - s * p[1], up = s * p[0] + c * p[1];
    seen[Channel::kBodyX] += across;
    seen[Channel::kBodyY] += up;
    seen[Channel::kBodyVx] -= rate * up;
    seen[Channel::kBodyVy] += rate * across;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect marker_offset = MakeEffect<MarkerOffset>();
}
}  // namespace hoplab
