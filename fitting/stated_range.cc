#include "fitting/stated_range.h"

#include "base/input_error.h"
#include "base/text.h"
#include "base/units.h"
#include "datasets/mechanism_ranges.h"
#include "datasets/read_spec.h"

namespace hoplab {
namespace {

Range TouchdownRange(MechanismKind mechanism) {
  const Range degrees = TouchdownAngleRange(mechanism);
  return {DegToRad(degrees.low), DegToRad(degrees.high), degrees.low_open, degrees.high_open,
          "rad"};
}

Range RobotRange(ParameterId id, const Parameters<double>& of) {
  using enum ParameterId;
  switch (id) {
    case kPitchInertia:
      return stated::kPitchInertia;
    case kComX:
    case kComY:
      return stated::kPlace;
    case kRotorInertia:
      return stated::kRotorInertia;
    case kMotorKp:
      return stated::kMotorKp;
    case kMotorKd:
      return stated::kMotorKd;
    case kFriction:
      return stated::kFriction;
    case kLegDamping:
      return stated::kMaterialDamping;
    case kE1:
    case kE2:
    case kE3:
    case kE4:
      return stated::kModulus;
    case kClockPeriod:
      return stated::kPeriod;
    case kClamp:
      return stated::Clamp(of.r);
    case kLegMass:
      return stated::kLegMass;
    case kClockDuty:
      return stated::kDuty;
    case kClockSweep:
      return stated::kSweep;
    case kClockOffset:
      return stated::kAngle;
    case kClockPhase1:
    case kClockPhase2:
    case kClockPhase3:
    case kClockPhase4:
      return stated::kPhase;
    case kLateralStiffness:
      return stated::kStiffness;
    default:
      return kAnyNumber;  // unreachable: the others are not of a robot
  }
}

}  // namespace

Range StatedRange(ParameterId id, MechanismKind mechanism, const Parameters<double>& of) {
  using enum ParameterId;
  switch (id) {
    case kE:
    case kG:
      return stated::kModulus;
    case kD:
      return stated::kDamping;
    case kM:
      return stated::kMass;
    case kR:
    case kRestLength:
    case kRadius:
      return stated::kLength;
    case kGravity:
      return stated::kGravity;
    case kKp:
      return stated::kSpeedGain;
    case kVDes:
      return stated::kSpeed;
    case kThetaTd:
      return TouchdownRange(mechanism);
    case kSecondMoment:
      return stated::kSecondMoment;
    case kArea:
      return stated::kArea;
    case kShearFactor:
      return stated::kShearFactor;
    case kStiffness:
      return stated::kStiffness;
    case kRestitution:
    case kTangentialLoss:
      return stated::kFraction;
    case kToeMass:
      return stated::kToeMass;
    case kKpPlace:
      return stated::kMotorKp;
    case kKdPlace:
      return stated::kMotorKd;
    default:
      return RobotRange(id, of);
  }
}

void CheckStatedValue(ParameterId id, double value, MechanismKind mechanism,
                      const Parameters<double>& of, const std::string& name,
                      const std::string& place) {
  const Range range = StatedRange(id, mechanism, of);
  if (range.Contains(value)) return;
  throw InputError({place, name + " = " + FormatDouble(value), "must be in " + range.Text(),
                    RangeRemedy(value, range)});
}

}  // namespace hoplab
