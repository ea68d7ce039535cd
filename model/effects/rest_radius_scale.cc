#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct RestRadiusScale {
  static constexpr std::array kParameters = {EffectParameter{"rho_r", "-", 0.0, -0.5, 1.0, 0.01}};
  static constexpr std::array kLaws = {Law::kThesis, Law::kNoSlip, Law::kConsistent,
                                       Law::kLargeDeflection, Law::kElastica};
  static constexpr EffectInfo kInfo = {
      .name = "rest_radius_scale",
      .kind = EffectKind::kParameter,
      .equation = "r (1 + rho_r)",
      .sentence =
          "the unloaded leg is rounder or flatter than stated: set from use, or the radius was "
          "measured at the wrong face",
      .for_legs = true,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .only_laws = kLaws,
      .for_robot = true,
      .arcs_only = true};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.r *= 1.0 + p[0];
  }
};

}  // namespace

namespace effects {
extern constexpr Effect rest_radius_scale = MakeEffect<RestRadiusScale>();
}
}  // namespace hoplab
