#include "experiments/identification/study_model.h"

#include <cmath>

namespace hoplab {
namespace {

using C = StudyConstant;

constexpr double kGravity = 9.81;  // m/s^2
// What nothing hangs on.
constexpr double kWidth = 0.03;        // m
constexpr double kShearModulus = 4e9;  // Pa

// A start at 0.2 m has to be above touch-down at 40 deg: r < 0.1132 m.
constexpr std::array<StudyConstantInfo, kStudyConstantCount> kInfo = {{
    {"body_mass", "kg", "body mass", 0.08, 5.0, 1.0},
    {"rest_radius", "m", "radius of the unloaded leg", 0.06, 0.113, 0.1},
    {"bending_stiffness", "N m^2", "E I at 22 GPa", 0.3, 30.0, 5.0},
    {"kp", "N s", "gain of the speed controller", 0.02, 60.0, 1.0},
    {"start_speed", "m/s", "start speed of table 6.5", 0.7, 1.4, 1.0},
    {"damping_scale", "", "damping over the printed one", 0.1, 3.0, 1.0},
    {"rolling_blend", "", "share of the arc laid down in the rolling (M27); no reading of the text",
     0.001, 1.0, 0.0},
    {"toe_mass", "kg", "mass at the toe (M40-M46); 0: the massless leg", 1e-3, 0.2, 0.0},
    {"placement_rate", "rad/s", "rate at which the toe is placed in flight", 5.0, 120.0, 60.0},
    {"placement_damping", "", "damping of the placement over the critical one", 0.05, 3.0, 0.7},
    {"placed_share", "", "leg angle of later landings over the first one's (M47)", 0.2, 1.2, 1.0},
    {"desired_speed", "m/s", "desired speed of the controller", 1.0, 3.0, 1.8},
}};

}  // namespace

const StudyConstantInfo& InfoOf(StudyConstant constant) {
  return kInfo[static_cast<std::size_t>(constant)];
}

StudyConstants ConstantsAsPrinted() {
  StudyConstants constants;
  for (std::size_t i = 0; i < constants.size(); ++i) constants[i] = kInfo[i].if_printed;
  return constants;
}

bool IsInEnergy(StudyConstant constant) {
  return constant != C::kGain && constant != C::kDesiredSpeed && constant != C::kPlacedShare &&
         constant != C::kPlacementRate && constant != C::kPlacementDamping;
}

bool NeedsToeMass(StudyConstant constant) {
  return constant == C::kToeMass || constant == C::kPlacementRate ||
         constant == C::kPlacementDamping;
}

StudySection SectionOf(double bending_stiffness_N_m2) {
  const double second_moment = bending_stiffness_N_m2 / kStudyModulus;
  const double thickness = std::cbrt(12.0 * second_moment / kWidth);
  return {kWidth, thickness, second_moment, kWidth * thickness};
}

StudyPlacement PlacementOf(const StudyConstants& constants) {
  const double length = 2.0 * At(constants, C::kRadius), rate = At(constants, C::kPlacementRate);
  const double inertia = At(constants, C::kToeMass) * length * length;
  return {rate * rate * inertia, 2.0 * At(constants, C::kPlacementDamping) * rate * inertia};
}

SimulationRequest RequestOf(const StudyHopper& hopper, double modulus_Pa, double damping_N_s_per_m,
                            double leg_angle_rad) {
  const StudySection section = SectionOf(At(hopper.constants, C::kBendingStiffness));
  SimulationRequest request;
  request.law = Law::kThesis;
  request.liftoff = hopper.reading.liftoff;
  request.integrator = hopper.integrator;
  Parameters<double>& p = request.parameters;
  p.reading = hopper.reading.law;
  p.m = At(hopper.constants, C::kMass);
  p.g = kGravity;
  p.r = At(hopper.constants, C::kRadius);
  p.E = modulus_Pa;
  p.G = kShearModulus;
  p.I = section.second_moment_m4;
  p.A = section.area_m2;
  p.d = At(hopper.constants, C::kDampingScale) * damping_N_s_per_m;
  p.start_angle = leg_angle_rad;
  p.theta_td = At(hopper.constants, C::kPlacedShare) * leg_angle_rad;
  p.m_toe = At(hopper.constants, C::kToeMass);
  const StudyPlacement placement = PlacementOf(hopper.constants);
  p.kp_place = placement.kp_N_m_per_rad;
  p.kd_place = placement.kd_N_m_s_per_rad;
  return request;
}

std::vector<EffectSetting> EffectsOf(const StudyHopper& hopper) {
  const double blend = At(hopper.constants, C::kRollingBlend);
  if (blend == 0.0) return {};
  EffectSetting setting = EffectSetting::Null(*FindEffect("rolling_law"));
  setting.values[0] = blend;
  return {setting};
}

}  // namespace hoplab
