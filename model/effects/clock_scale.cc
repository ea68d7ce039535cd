#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct ClockScale {
  static constexpr std::array kParameters = {
      EffectParameter{"gamma_t", "-", 0.0, -0.05, 0.05, 0.002}};
  static constexpr EffectInfo kInfo = {.name = "clock_scale",
                                       .kind = EffectKind::kObservation,
                                       .equation = "the row stamped t was read at t/(1 + gamma_t)",
                                       .sentence = "the clock of the recording runs fast or slow",
                                       .for_legs = true,
                                       .for_ball = true,
                                       .dissipative = false,
                                       .order = 1,
                                       .parameters = kParameters,
                                       .for_robot = true};

  template <class T>
  static void ChangeObservationTime(const T* p, T& t) {
    t /= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect clock_scale = MakeEffect<ClockScale>();
}
}  // namespace hoplab
