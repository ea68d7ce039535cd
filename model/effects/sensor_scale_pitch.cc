#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SensorScalePitch {
  static constexpr std::array kParameters = {EffectParameter{"gain", "-", 0.0, -0.5, 0.5, 0.01}};
  static constexpr EffectInfo kInfo = {
      .name = "sensor_scale_pitch",
      .kind = EffectKind::kObservation,
      .equation = "body_pitch (1 + gain)",
      .sentence = "the pitch is measured too large or too small: a gyroscope whose gain is off",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .order = 3,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeObservation(const T* p, Observation<T>& seen) {
    if (seen.Has(Channel::kBodyPitch)) seen[Channel::kBodyPitch] *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_scale_pitch = MakeEffect<SensorScalePitch>();
}
}  // namespace hoplab
