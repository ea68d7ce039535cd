#include <array>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct HipSpacing {
  static constexpr std::array kParameters = {EffectParameter{"gain", "-", 0.0, -0.5, 0.5, 0.02}};
  static constexpr EffectInfo kInfo = {
      .name = "hip_spacing",
      .kind = EffectKind::kParameter,
      .equation = "hips at x_m + (1 + gain) (x_i - x_m), x_m their mean (M106)",
      .sentence = "the robot's hips sit further apart, or closer, than was stated",
      .for_legs = false,
      .for_ball = false,
      .dissipative = false,
      .parameters = kParameters,
      .for_robot = true,
      .least_legs = 2};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    RobotParameters<T>& robot = *parameters.robot;
    T mean(0.0);
    for (int i = 0; i < robot.legs; ++i) mean += robot.hip_x[i] / static_cast<double>(robot.legs);
    for (int i = 0; i < robot.legs; ++i) robot.hip_x[i] += p[0] * (robot.hip_x[i] - mean);
  }
};

}  // namespace

namespace effects {
extern constexpr Effect hip_spacing = MakeEffect<HipSpacing>();
}
}  // namespace hoplab
