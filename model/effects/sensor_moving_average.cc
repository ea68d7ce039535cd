#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SensorMovingAverage {
  static constexpr std::array kParameters = {EffectParameter{"width", "s", 0.0, 0.0, 0.1, 0.03}};
  static constexpr EffectInfo kInfo = {
      .name = "sensor_moving_average",
      .kind = EffectKind::kObservation,
      .equation = "place and pitch are the means from t - width/2 to t + width/2 (M117)",
      .sentence = "each sample is the mean of those about it",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .has_threshold = true,
      .parameters = kParameters,
      .for_robot = true,
      .filter = RecordFilter::kMovingAverage};
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_moving_average = MakeEffect<SensorMovingAverage>();
}
}  // namespace hoplab
