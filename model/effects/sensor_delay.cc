#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SensorDelay {
  static constexpr std::array kParameters = {EffectParameter{"tau", "s", 0.0, -0.1, 0.1, 0.002}};
  static constexpr EffectInfo kInfo = {
      .name = "sensor_delay",
      .kind = EffectKind::kObservation,
      .equation = "every channel is read at t - tau",
      .sentence = "the sensors report what was true a moment before",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .order = 2,
      .parameters = kParameters,
      .for_robot = true};

  template <class T>
  static void ChangeObservationTime(const T* p, T& t) {
    t -= p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_delay = MakeEffect<SensorDelay>();
}
}  // namespace hoplab
