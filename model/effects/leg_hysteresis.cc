#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct LegHysteresis {
  static constexpr std::array kParameters = {EffectParameter{"eta", "-", 0.0, 0.0, 1.0, 0.02}};
  static constexpr EffectInfo kInfo = {.name = "leg_hysteresis",
                                       .kind = EffectKind::kForce,
                                       .equation = "F_chord - eta F_el tanh(w/(0.05 m/s))",
                                       .sentence =
                                           "the leg gives back a fixed part less than it took, "
                                           "however slowly it is bent: rubbing layers, rubber",
                                       .for_legs = true,
                                       .for_ball = false,
                                       .dissipative = true,
                                       .sharp = true,
                                       .parameters = kParameters};
  static constexpr double kWidth = 0.05;  // m/s

  template <class T>
  static void AddChordForce(const T* p, const ChordMotion<T>& chord, T& force) {
    using std::tanh;
    force -= p[0] * chord.elastic_force * tanh(chord.rate / kWidth);
  }
};

}  // namespace

namespace effects {
extern constexpr Effect leg_hysteresis = MakeEffect<LegHysteresis>();
}
}  // namespace hoplab
