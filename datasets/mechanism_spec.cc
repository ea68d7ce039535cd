#include "datasets/mechanism_spec.h"

#include <cmath>

#include "base/units.h"

namespace hoplab {

double TouchdownHeight(const MechanismSpec& mechanism, double touchdown_angle_rad) {
  const double cosine = std::cos(touchdown_angle_rad);
  switch (mechanism.type) {
    case MechanismKind::kCLeg: {
      const double radius = mechanism.c_leg.rest_radius_m;
      return touchdown_angle_rad > 0 ? radius * (1 + cosine) : 2 * radius * cosine;
    }
    case MechanismKind::kStraightLeg:
      return mechanism.straight_leg.rest_length_m * cosine;
    case MechanismKind::kBall:
      return mechanism.ball.radius_m;
    case MechanismKind::kRobot:
      break;  // each of its legs has its own
  }
  return std::nan("");
}

double FreeFall(const MechanismSpec& mechanism) {
  const double g = mechanism.gravity_m_per_s2;
  if (mechanism.type != MechanismKind::kBall) return g;
  const BallSpec& ball = mechanism.ball;
  const double air =
      ball.air_density_kg_per_m3.value_or(0.0) * 4.0 / 3.0 * kPi * std::pow(ball.radius_m, 3);
  return g / (1.0 + 1.5 * air / mechanism.body_mass_kg);
}

}  // namespace hoplab
