#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SensorOffsetY {
  static constexpr std::array kParameters = {EffectParameter{"offset", "m", 0.0, -1.0, 1.0, 0.005}};
  static constexpr EffectInfo kInfo = {
      .name = "sensor_offset_y",
      .kind = EffectKind::kObservation,
      .equation = "body_y + offset",
      .sentence = "the marker is above or below the hip, or the ground is not at zero",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .order = 4,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeObservation(const T* p, Observation<T>& seen) {
    seen[Channel::kBodyY] += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_offset_y = MakeEffect<SensorOffsetY>();
}
}  // namespace hoplab
