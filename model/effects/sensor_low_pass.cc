#include <array>

#include "model/effects/filter.h"

namespace hoplab {
namespace {

struct SensorLowPass {
  static constexpr std::array kParameters = {EffectParameter{"tau", "s", 0.0, 0.0, 0.05, 0.01}};
  static constexpr EffectInfo kInfo =
      FilterInfo("sensor_low_pass", RecordFilter::kTwoPass, kParameters,
                 "place and pitch went through 1/(1 + (2 pi f tau)^4), without a lag (M105)",
                 "the traces were smoothed before they were logged, and their corners with them");
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_low_pass = MakeEffect<SensorLowPass>();
}
}  // namespace hoplab
