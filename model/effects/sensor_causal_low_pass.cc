#include <array>

#include "model/effects/filter.h"

namespace hoplab {
namespace {

struct SensorCausalLowPass {
  static constexpr std::array kParameters = {EffectParameter{"tau", "s", 0.0, 0.0, 0.05, 0.01}};
  static constexpr EffectInfo kInfo = FilterInfo(
      "sensor_causal_low_pass", RecordFilter::kOnePass, kParameters,
      "place and pitch went through 1/(1 + i sqrt(2) w tau - (w tau)^2), w = 2 pi f (M117)",
      "the traces went through a filter as they were logged: they are late, and their corners "
      "round");
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_causal_low_pass = MakeEffect<SensorCausalLowPass>();
}
}  // namespace hoplab
