#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct SensorExponentialFilter {
  static constexpr std::array kParameters = {EffectParameter{"tau", "s", 0.0, 0.0, 0.05, 0.01}};
  static constexpr EffectInfo kInfo = {
      .name = "sensor_exponential_filter",
      .kind = EffectKind::kObservation,
      .equation = "place and pitch went through 1/(1 + i 2 pi f tau) (M117)",
      .sentence =
          "each sample was mixed with those before it, as exponential smoothing or an RC circuit "
          "does",
      .for_legs = true,
      .for_ball = true,
      .dissipative = false,
      .has_threshold = true,
      .parameters = kParameters,
      .for_robot = true,
      .filter = RecordFilter::kFirstOrder};
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_exponential_filter = MakeEffect<SensorExponentialFilter>();
}
}  // namespace hoplab
