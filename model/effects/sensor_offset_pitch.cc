#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SensorOffsetPitch {
  static constexpr std::array kParameters = {
      EffectParameter{"offset", "rad", 0.0, -0.5, 0.5, 0.005}};
  static constexpr EffectInfo kInfo = {
      .name = "sensor_offset_pitch",
      .kind = EffectKind::kObservation,
      .equation = "body_pitch + offset",
      .sentence = "what measures the pitch is mounted askew on the body",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .order = 4,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeObservation(const T* p, Observation<T>& seen) {
    if (seen.Has(Channel::kBodyPitch)) seen[Channel::kBodyPitch] += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_offset_pitch = MakeEffect<SensorOffsetPitch>();
}
}  // namespace hoplab
