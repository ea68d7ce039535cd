#include "experiments/leg_stiffness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/leg_compliance.h"

namespace hoplab {
namespace {

// Of `thesis` and `no_slip`.
double ChordStiffness(const Parameters<double>& p, double leg_angle, double length) {
  const double alpha = 0.5 * std::max(leg_angle, 0.0);  // below 0 the toe carries: phi stays pi
  const bool at_rest = p.reading.stiffness_radius == ThesisReading::StiffnessRadius::kRest;
  const double radius = at_rest ? p.r : length / (2.0 * std::cos(alpha));
  const bool of_theta = p.reading.stiffness_angle == ThesisReading::StiffnessAngle::kTheta;
  const double angle = of_theta ? 2.0 * alpha : alpha;
  return 1.0 / LegCompliance<double>(p, radius).Chord(std::numbers::pi - angle);
}

}  // namespace

double StanceStiffness(const SimulationRequest& request, double leg_angle, double length) {
  const Parameters<double>& p = request.parameters;
  if (request.law == Law::kStraightLeg) return p.k;
  if (request.law == Law::kThesis || request.law == Law::kNoSlip)
    return ChordStiffness(p, leg_angle, length);
  // Below 0 the toe carries: phi stays pi.
  return 1.0 / LegCompliance<double>(p).Chord(std::numbers::pi - std::max(leg_angle, 0.0));
}

}  // namespace hoplab
