#include "experiments/identification/energy_jump.h"

#include <vector>

namespace hoplab {
namespace {

using C = StudyConstant;
using D = SensitivityDirection;

constexpr double kLongestJump = 5.0;  // s

// Directions of the jump: body and leg, then what an effect and a toe mass bring.
std::vector<D> DirectionsOf(bool has_effect, bool has_toe) {
  std::vector<D> directions = {D::Parameter(ParameterId::kM),
                               D::Parameter(ParameterId::kR),
                               D::Parameter(ParameterId::kSecondMoment),
                               D::Parameter(ParameterId::kArea),
                               D::Parameter(ParameterId::kD),
                               D::InitialState(2)};
  if (has_effect) directions.push_back(D::EffectParameter(0, 0));
  if (has_toe) {
    for (ParameterId id : {ParameterId::kThetaTd, ParameterId::kToeMass, ParameterId::kKpPlace,
                           ParameterId::kKdPlace})
      directions.push_back(D::Parameter(id));
  }
  return directions;
}

// The body's energy at the end of `run` over its mass, and what it changes by per direction: along
// the apex, for a body that its leg's vibration shakes in flight.
struct ApexEnergy {
  double value;
  std::vector<double> by;
};
ApexEnergy EnergyAtEnd(const Trajectory& run, double gravity) {
  const std::vector<double>& z = run.final_state;
  ApexEnergy energy{gravity * z[1] + 0.5 * (z[2] * z[2] + z[3] * z[3]), {}};
  const auto width = static_cast<std::size_t>(run.directions);
  for (std::size_t i = 0; i < width; ++i) {
    const double apex_time = run.event_time_sensitivities[(run.events.size() - 1) * width + i];
    const auto slope = [&](std::size_t component) {
      return run.final_sensitivities[component * width + i] + run.final_rate[component] * apex_time;
    };
    energy.by.push_back(gravity * slope(1) + z[2] * slope(2) + z[3] * slope(3));
  }
  return energy;
}

}  // namespace

std::optional<double> EnergyPercent(const StudyHopper& hopper, const EnergyCell& cell,
                                    StudySlopes* slopes) {
  SimulationRequest request =
      RequestOf(hopper, kStudyModulus, cell.damping_N_s_per_m, cell.touchdown_angle_rad);
  const double speed = At(hopper.constants, C::kStartSpeed);
  request.initial = {0.0, kStudyHeight, speed, 0.0};
  request.horizon = kLongestJump;
  request.max_hops = 1;
  const std::vector<EffectSetting> effects = EffectsOf(hopper);
  request.effects = effects;
  const bool has_toe = HasToeMass(hopper), has_effect = !effects.empty();
  const std::vector<D> directions = DirectionsOf(has_effect, has_toe);
  if (slopes) request.directions = directions;
  const Trajectory run = Simulate(request);
  if (!IsComplete(run.outcome) || run.hops < 1) return std::nullopt;
  const Parameters<double>& p = request.parameters;
  const double before = p.g * kStudyHeight + 0.5 * speed * speed;  // per kg
  const ApexEnergy after = EnergyAtEnd(run, p.g);
  const double percent = 100.0 * after.value / before;
  if (!slopes) return percent;
  const auto by = [&](std::size_t i) { return 100.0 / before * after.by[i]; };
  const auto slope = [&](C c) -> double& { return (*slopes)[static_cast<std::size_t>(c)]; };
  slopes->fill(0.0);
  slope(C::kMass) = p.m * by(0);
  slope(C::kRadius) = p.r * by(1);
  slope(C::kBendingStiffness) = p.I * by(2) + p.A / 3.0 * by(3);
  slope(C::kDampingScale) = p.d * by(4);
  slope(C::kStartSpeed) = speed * (by(5) - percent * speed / before);
  if (has_effect) slope(C::kRollingBlend) = effects[0].values[0] * by(6);
  if (has_toe) {
    // The leg is placed on its way to the apex, and pushes the hip. The placement goes with m_toe
    // r^2; the rate squared is in kp, the rate in kd.
    const std::size_t toe = directions.size() - 3;
    const double kp = p.kp_place * by(toe + 1), kd = p.kd_place * by(toe + 2);
    slope(C::kPlacedShare) = p.theta_td * by(toe - 1);
    slope(C::kToeMass) = p.m_toe * by(toe) + kp + kd;
    slope(C::kRadius) += 2.0 * (kp + kd);
    slope(C::kPlacementRate) = 2.0 * kp + kd;
    slope(C::kPlacementDamping) = kd;
  }
  return percent;
}

}  // namespace hoplab
