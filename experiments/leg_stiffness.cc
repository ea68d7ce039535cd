#include "experiments/leg_stiffness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/leg_compliance.h"

namespace hoplab {

double StanceStiffness(const SimulationRequest& request, double leg_angle, double length) {
  const Parameters<double>& p = request.parameters;
  if (request.law == Law::kStraightLeg) return p.k;
  const ThesisVariant variant = request.law == Law::kThesis ? p.variant : ThesisVariant();
  const double theta = std::max(leg_angle, 0.0);  // below 0 the toe carries: phi stays pi
  const bool deformed = request.law == Law::kNoSlip ||
                        (request.law == Law::kThesis &&
                         variant.stiffness_radius == ThesisVariant::StiffnessRadius::kDeformed);
  // r_d = l/(2 cos alpha), which is l/2 on the toe.
  const double radius = deformed ? length / (2.0 * std::cos(0.5 * theta)) : p.r;
  const bool of_theta = variant.stiffness_angle == ThesisVariant::StiffnessAngle::kTheta;
  const double angle = of_theta ? theta : 0.5 * theta;
  return 1.0 / LegCompliance<double>(p, radius).Chord(std::numbers::pi - angle);
}

}  // namespace hoplab
