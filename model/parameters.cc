#include "model/parameters.h"

#include <algorithm>
#include <array>

#include "base/check.h"

namespace hoplab {
namespace {

using enum ParameterId;

constexpr std::array<ParameterInfo, 43> kParameters = {{
    {kE, "E", "Pa", 1e3, 1e13},
    {kG, "G", "Pa", 1e3, 1e13},
    {kD, "d", "N s/m", 0.0, 1e5},
    {kM, "m", "kg", 1e-6, 1e6},
    {kR, "r", "m", 1e-4, 1e2},
    {kGravity, "g", "m/s^2", 0.0, 1e3},
    {kKp, "kp", "N s", -1e6, 1e6},
    {kVDes, "v_des", "m/s", -1e3, 1e3},
    {kThetaTd, "theta_td", "rad", -1.55, 2.9},
    {kSecondMoment, "I", "m^4", 1e-20, 1.0},
    {kArea, "A", "m^2", 1e-12, 1e2},
    {kShearFactor, "kappa", "-", 0.0, 10.0},
    {kStiffness, "k", "N/m", 1e-3, 1e9},
    {kRestLength, "l0", "m", 1e-4, 1e2},
    {kRestitution, "restitution", "-", 0.0, 1.0},
    {kTangentialLoss, "tangential_loss", "-", -1.0, 2.0},
    {kRadius, "radius", "m", 0.0, 1e2},
    {kToeMass, "m_toe", "kg", 1e-6, 1e6},
    {kKpPlace, "kp_place", "N m/rad", 0.0, 1e6},
    {kKdPlace, "kd_place", "N m s/rad", 0.0, 1e6},
    {kPitchInertia, "pitch_inertia", "kg m^2", 1e-9, 1e6},
    {kComX, "com_x", "m", -1e2, 1e2},
    {kComY, "com_y", "m", -1e2, 1e2},
    {kRotorInertia, "rotor_inertia", "kg m^2", 1e-9, 1e3},
    {kMotorKp, "motor_kp", "N m/rad", 0.0, 1e6},
    {kMotorKd, "motor_kd", "N m s/rad", 0.0, 1e6},
    {kFriction, "friction", "-", 1e-3, 1e3},
    {kLegDamping, "leg_damping", "s", 0.0, 0.1},
    {kE1, "E_1", "Pa", 1e3, 1e13},
    {kE2, "E_2", "Pa", 1e3, 1e13},
    {kE3, "E_3", "Pa", 1e3, 1e13},
    {kE4, "E_4", "Pa", 1e3, 1e13},
    {kClockPeriod, "clock_period", "s", 1e-3, 1e3},
    {kClamp, "clamp", "m", 0.0, 1e2},
    {kLegMass, "leg_mass", "kg", 0.0, 1e3},
    {kClockDuty, "clock_duty", "-", 1e-6, 1.0 - 1e-6},
    {kClockSweep, "clock_sweep", "rad", 1e-6, 6.2831},
    {kClockOffset, "clock_offset", "rad", -1e3, 1e3},
    {kClockPhase1, "clock_phase_1", "-", -1e3, 1e3},
    {kClockPhase2, "clock_phase_2", "-", -1e3, 1e3},
    {kClockPhase3, "clock_phase_3", "-", -1e3, 1e3},
    {kClockPhase4, "clock_phase_4", "-", -1e3, 1e3},
    {kLateralStiffness, "k_lateral", "N/m", 1e-3, 1e9},
}};

constexpr std::array kCLegParameters = {
    kE, kD, kG, kM, kR, kGravity, kKp, kVDes, kThetaTd, kSecondMoment, kArea, kShearFactor};
constexpr std::array kStraightLegParameters = {kStiffness, kD,  kRestLength, kM,
                                               kGravity,   kKp, kVDes,       kThetaTd};
constexpr std::array kToeParameters = {kToeMass, kKpPlace, kKdPlace};
constexpr std::array kBallParameters = {kRestitution, kTangentialLoss, kM, kGravity, kRadius};

constexpr std::array kRobotParameters = {kE,
                                         kLegDamping,
                                         kE1,
                                         kE2,
                                         kE3,
                                         kE4,
                                         kM,
                                         kGravity,
                                         kR,
                                         kSecondMoment,
                                         kPitchInertia,
                                         kComX,
                                         kComY,
                                         kRotorInertia,
                                         kMotorKp,
                                         kMotorKd,
                                         kFriction,
                                         kClamp,
                                         kLegMass,
                                         kStiffness,
                                         kRestLength,
                                         kLateralStiffness};
// Of them those that only half circles have, and those that only straight legs have.
constexpr std::array kOfArcs = {kE, kE1, kE2, kE3, kE4, kR, kSecondMoment, kClamp};
constexpr std::array kOfRods = {kStiffness, kRestLength, kLateralStiffness};

constexpr std::array kClockParameters = {kClockPeriod, kClockDuty,   kClockSweep,  kClockOffset,
                                         kClockPhase1, kClockPhase2, kClockPhase3, kClockPhase4};

}  // namespace

std::span<const ParameterInfo> AllParameters() { return kParameters; }

const ParameterInfo& InfoOf(ParameterId id) { return kParameters[static_cast<std::size_t>(id)]; }

std::optional<ParameterId> FindParameter(std::string_view name) {
  for (const ParameterInfo& info : kParameters) {
    if (info.name == name) return info.id;
  }
  return std::nullopt;
}

std::span<const ParameterId> ParametersOf(MechanismKind mechanism) {
  switch (mechanism) {
    case MechanismKind::kCLeg:
      return kCLegParameters;
    case MechanismKind::kStraightLeg:
      return kStraightLegParameters;
    case MechanismKind::kBall:
      return kBallParameters;
    case MechanismKind::kRobot:
      return kRobotParameters;
  }
  return {};
}

bool IsOfLegs(ParameterId id, const Parameters<double>& p) {
  if (!p.robot) return true;
  const auto has = [id](const auto& list) {
    return std::find(list.begin(), list.end(), id) != list.end();
  };
  return p.robot->straight_legs ? !has(kOfArcs) : !has(kOfRods);
}

std::span<const ParameterId> ClockParameters() { return kClockParameters; }

std::span<const ParameterId> ToeParameters() { return kToeParameters; }

std::span<const ParameterId> FreeByDefault(MechanismKind mechanism) {
  return ParametersOf(mechanism).first(2);
}

}  // namespace hoplab
