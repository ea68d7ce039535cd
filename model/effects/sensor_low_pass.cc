#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SensorLowPass {
  static constexpr std::array kParameters = {EffectParameter{"tau", "s", 0.0, 0.0, 0.05, 0.01}};
  static constexpr EffectInfo kInfo = {
      .name = "sensor_low_pass",
      .kind = EffectKind::kObservation,
      .equation = "place and pitch went through 1/(1 + (2 pi f tau)^4), without a lag (M105)",
      .sentence = "the traces were smoothed before they were logged, and their corners with them",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .has_threshold = true,
      .parameters = kParameters,
      .for_robot = true,
      .filter = RecordFilter::kTwoPass};
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_low_pass = MakeEffect<SensorLowPass>();
}
}  // namespace hoplab
