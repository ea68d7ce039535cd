#include "model/parameters.h"

#include <algorithm>
#include <array>

#include "base/check.h"

namespace hoplab {
namespace {

using enum ParameterId;

constexpr std::array<ParameterInfo, 42> kParameters = {{
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
}};

constexpr std::array kCLegParameters = {
    kE, kD, kG, kM, kR, kGravity, kKp, kVDes, kThetaTd, kSecondMoment, kArea, kShearFactor};
constexpr std::array kStraightLegParameters = {kStiffness, kD,  kRestLength, kM,
                                               kGravity,   kKp, kVDes,       kThetaTd};
constexpr std::array kToeParameters = {kToeMass, kKpPlace, kKdPlace};
constexpr std::array kBallParameters = {kRestitution, kTangentialLoss, kM, kGravity, kRadius};

constexpr std::array kRobotParameters = {
    kE,       kLegDamping, kE1,           kE2,           kE3,     kE4,   kM,
    kGravity, kR,          kSecondMoment, kPitchInertia, kComX,   kComY, kRotorInertia,
    kMotorKp, kMotorKd,    kFriction,     kClamp,        kLegMass};

constexpr std::array kClockParameters = {kClockPeriod, kClockDuty,   kClockSweep,  kClockOffset,
                                         kClockPhase1, kClockPhase2, kClockPhase3, kClockPhase4};

struct LawRow {
  Law law;
  MechanismKind mechanism;
  std::string_view name;
  std::string_view sentence;
};
// Of each mechanism the default comes first.
constexpr auto kLaws = std::to_array<LawRow>({
    {Law::kElastica, MechanismKind::kCLeg, "elastica",
     "c_leg, default: static equilibrium of an inextensible elastic arc, exact for any load; "
     "conserves energy."},
    {Law::kLargeDeflection, MechanismKind::kCLeg, "large_deflection",
     "c_leg: static equilibrium of the elastic arc with the next term of the elastica; conserves "
     "energy."},
    {Law::kConsistent, MechanismKind::kCLeg, "consistent",
     "c_leg: static equilibrium of the elastic arc, first-order bending with tip rotation; "
     "conserves energy."},
    {Law::kNoSlip, MechanismKind::kCLeg, "no_slip",
     "c_leg: half circle of varying radius, the contact advances by the arc laid on the ground."},
    {Law::kThesis, MechanismKind::kCLeg, "thesis",
     "c_leg: half circle of varying radius, the law of the published tables; does not conserve "
     "energy."},
    {Law::kStraightLeg, MechanismKind::kStraightLeg, "straight_leg",
     "straight_leg: linear spring and damper on a fixed toe."},
    {Law::kBall, MechanismKind::kBall, "ball",
     "ball: ballistic flight, restitution and tangential loss at each bounce."},
    {Law::kRobot, MechanismKind::kRobot, "robot",
     "robot: a body with pitch on up to four legs, each an exact elastic arc clamped to its "
     "motor."},
});

const LawRow& RowOf(Law law) {
  return *std::find_if(kLaws.begin(), kLaws.end(),
                       [&](const LawRow& row) { return row.law == law; });
}

constexpr std::size_t CountOf(MechanismKind mechanism) {
  std::size_t count = 0;
  for (const LawRow& row : kLaws) count += row.mechanism == mechanism ? 1 : 0;
  return count;
}
template <MechanismKind kMechanism>
constexpr auto kLawsOf = [] {
  std::array<Law, CountOf(kMechanism)> laws{};
  std::size_t count = 0;
  for (const LawRow& row : kLaws) {
    if (row.mechanism == kMechanism) laws[count++] = row.law;
  }
  return laws;
}();

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

std::span<const ParameterId> ClockParameters() { return kClockParameters; }

std::span<const ParameterId> ToeParameters() { return kToeParameters; }

std::span<const ParameterId> FreeByDefault(MechanismKind mechanism) {
  return ParametersOf(mechanism).first(2);
}

std::span<const Law> LawsOf(MechanismKind mechanism) {
  switch (mechanism) {
    case MechanismKind::kCLeg:
      return kLawsOf<MechanismKind::kCLeg>;
    case MechanismKind::kStraightLeg:
      return kLawsOf<MechanismKind::kStraightLeg>;
    case MechanismKind::kBall:
      return kLawsOf<MechanismKind::kBall>;
    case MechanismKind::kRobot:
      return kLawsOf<MechanismKind::kRobot>;
  }
  return {};
}

MechanismKind MechanismOf(Law law) { return RowOf(law).mechanism; }

std::string_view NameOf(Law law) { return RowOf(law).name; }

std::string_view SentenceOf(Law law) { return RowOf(law).sentence; }

std::string_view NameOf(MechanismKind mechanism) {
  switch (mechanism) {
    case MechanismKind::kCLeg:
      return "c_leg";
    case MechanismKind::kStraightLeg:
      return "straight_leg";
    case MechanismKind::kBall:
      return "ball";
    case MechanismKind::kRobot:
      return "robot";
  }
  return "";
}

std::optional<Law> FindLaw(std::string_view name) {
  for (const LawRow& row : kLaws) {
    if (row.name == name) return row.law;
  }
  return std::nullopt;
}

}  // namespace hoplab
