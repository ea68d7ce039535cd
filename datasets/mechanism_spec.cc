#include "datasets/mechanism_spec.h"

#include <cmath>

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

}  // namespace hoplab
