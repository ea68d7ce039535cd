#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct LegQuadraticDamping {
  static constexpr std::array kParameters = {
      EffectParameter{"d2", "N s^2/m^2", 0.0, 0.0, 1e5, 2.0}};
  static constexpr EffectInfo kInfo = {
      .name = "leg_quadratic_damping",
      .kind = EffectKind::kForce,
      .equation = "F_chord - d2 |w| w",
      .sentence = "fast bending costs more than its share: air or oil pressed through gaps",
      .for_legs = true,
      .for_ball = false,
      .dissipative = true,
      .sharp = true,
      .parameters = kParameters};

  template <class T>
  static void AddChordForce(const T* p, const ChordMotion<T>& chord, T& force) {
    const double sign = Value(chord.rate) < 0.0 ? -1.0 : 1.0;
    force -= sign * p[0] * chord.rate * chord.rate;
  }
};

}  // namespace

namespace effects {
extern constexpr Effect leg_quadratic_damping = MakeEffect<LegQuadraticDamping>();
}
}  // namespace hoplab
