#include <array>

#include "model/effects/filter.h"

namespace hoplab {
namespace {

struct SensorMovingAverage {
  static constexpr std::array kParameters = {EffectParameter{"width", "s", 0.0, 0.0, 0.1, 0.03}};
  static constexpr EffectInfo kInfo =
      FilterInfo("sensor_moving_average", RecordFilter::kMovingAverage, kParameters,
                 "place and pitch are the means from t - width/2 to t + width/2 (M117)",
                 "each sample is the mean of those about it");
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_moving_average = MakeEffect<SensorMovingAverage>();
}
}  // namespace hoplab
