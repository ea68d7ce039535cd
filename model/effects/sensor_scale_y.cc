#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SensorScaleY {
  static constexpr std::array kParameters = {EffectParameter{"gain", "-", 0.0, -0.5, 0.5, 0.01}};
  static constexpr EffectInfo kInfo = {
      .name = "sensor_scale_y",
      .kind = EffectKind::kObservation,
      .equation = "body_y (1 + gain)",
      .sentence =
          "the upward coordinate is measured too long or too short: a calibration length was off",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .order = 3,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeObservation(const T* p, Observation<T>& seen) {
    seen[Channel::kBodyY] *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_scale_y = MakeEffect<SensorScaleY>();
}
}  // namespace hoplab
