#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SensorOffsetX {
  static constexpr std::array kParameters = {EffectParameter{"offset", "m", 0.0, -1.0, 1.0, 0.005}};
  static constexpr EffectInfo kInfo = {
      .name = "sensor_offset_x",
      .kind = EffectKind::kObservation,
      .equation = "body_x + offset",
      .sentence = "the marker is ahead of the hip or behind it, or the origin is elsewhere",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .order = 4,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeObservation(const T* p, Observation<T>& seen) {
    seen[Channel::kBodyX] += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_offset_x = MakeEffect<SensorOffsetX>();
}
}  // namespace hoplab
