#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct LegMaterialDamping {
  static constexpr std::array kParameters = {EffectParameter{"tau", "s", 0.0, 0.0, 0.1, 5e-4}};
  static constexpr EffectInfo kInfo = {
      .name = "leg_material_damping",
      .kind = EffectKind::kForce,
      .equation =
          "F_chord - tau k w, k the chord stiffness at that arc (M3); elastica: "
          "bending moment + tau E I dkappa/dt all along the arc (M63)",
      .sentence =
          "the leg's material itself is viscous (Kelvin-Voigt), so a stiffer, shorter arc "
          "damps more",
      .for_legs = true,
      .for_ball = false,
      .dissipative = true,
      .parameters = kParameters};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.law_terms.material_damping_active = true;
    parameters.law_terms.material_damping += p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect leg_material_damping = MakeEffect<LegMaterialDamping>();
}
}  // namespace hoplab
