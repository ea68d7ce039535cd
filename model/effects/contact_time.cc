#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct ContactTime {
  static constexpr std::array kParameters = {EffectParameter{"T_c", "s", 0.0, 0.0, 0.05, 0.002}};
  static constexpr EffectInfo kInfo = {
      .name = "contact_time",
      .kind = EffectKind::kGuard,
      .equation = "the flight after a bounce begins T_c later (M115)",
      .sentence = "the ball gives way and stays on the ground for a moment at each bounce",
      .for_legs = false,
      .for_ball = true,
      .dissipative = false,
      .parameters = kParameters};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.contact_time += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect contact_time = MakeEffect<ContactTime>();
}
}  // namespace hoplab
