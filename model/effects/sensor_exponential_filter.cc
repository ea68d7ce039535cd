#include <array>

#include "model/effects/filter.h"

namespace hoplab {
namespace {

struct SensorExponentialFilter {
  static constexpr std::array kParameters = {EffectParameter{"tau", "s", 0.0, 0.0, 0.05, 0.01}};
  static constexpr EffectInfo kInfo = FilterInfo(
      "sensor_exponential_filter", RecordFilter::kFirstOrder, kParameters,
      "place and pitch went through 1/(1 + i 2 pi f tau) (M117)",
      "each sample was mixed with those before it, as exponential smoothing or an RC circuit "
      "does");
};

}  // namespace

namespace effects {
extern constexpr Effect sensor_exponential_filter = MakeEffect<SensorExponentialFilter>();
}
}  // namespace hoplab
