#include "datasets/read_robot.h"

#include "base/input_error.h"
#include "base/range.h"
#include "datasets/mechanism_ranges.h"
#include "datasets/read_spec.h"

namespace hoplab {
namespace {

constexpr std::size_t kMostLegs = 4;

// [x, y]
void ReadPlace(const YamlCursor& cursor, double& x, double& y) {
  const std::vector<YamlCursor> items = cursor.Items(2);
  if (items.size() != 2) cursor.Fail("must be two numbers, [x, y]", "Remove the others.");
  x = items[0].Number(stated::kPlace);
  y = items[1].Number(stated::kPlace);
}

std::vector<double> ReadNumbers(const YamlCursor& cursor, const Range& range) {
  std::vector<double> numbers;
  for (const YamlCursor& item : cursor.Items(1)) numbers.push_back(item.Number(range));
  return numbers;
}

void ReadMotor(const YamlCursor& motor, RobotSpec& robot) {
  motor.AllowOnly(
      {"rotor_inertia_kg_m2", "kp_N_m_per_rad", "kd_N_m_s_per_rad", "torque_limit_N_m"});
  robot.rotor_inertia_kg_m2 = motor.RequiredNumber("rotor_inertia_kg_m2", stated::kRotorInertia);
  robot.kp_N_m_per_rad = motor.RequiredNumber("kp_N_m_per_rad", stated::kMotorKp);
  robot.kd_N_m_s_per_rad = motor.RequiredNumber("kd_N_m_s_per_rad", stated::kMotorKd);
  robot.torque_limit_N_m = motor.OptionalNumber("torque_limit_N_m", Positive(1e6, "N m"));
}

const std::vector<std::string> kOfArc = {"rest_radius_m", "E_Pa",    "width_m",
                                         "thickness_m",   "clamp_m", "second_moment_m4"};
const std::vector<std::string> kOfRod = {"rest_length_m", "stiffness_N_per_m",
                                         "lateral_stiffness_N_per_m"};

// Which keys a leg may have, by its type; those of the other type are told as such.
void AllowKeysOf(const YamlCursor& leg, bool straight) {
  for (const std::string& key : straight ? kOfArc : kOfRod)
    if (const auto other = leg.Optional(key))
      other->FailAtKey(
          straight ? "is of a half circle, and these legs are straight"
                   : "is of a straight leg, and these are half circles",
          straight ? "Remove it, or write type: arc." : "Write type: straight beside it.");
  std::vector<std::string> known = straight ? kOfRod : kOfArc;
  known.insert(known.end(), {"type", "material_damping_s", "mass_kg"});
  leg.AllowOnly(known);
}

void ReadStraightLeg(const YamlCursor& leg, RobotSpec& robot) {
  robot.rest_length_m = leg.RequiredNumber("rest_length_m", stated::kLength);
  robot.stiffness_N_per_m = leg.RequiredNumber("stiffness_N_per_m", stated::kStiffness);
  robot.lateral_stiffness_N_per_m =
      leg.RequiredNumber("lateral_stiffness_N_per_m", stated::kStiffness);
  robot.material_damping_s = leg.RequiredNumber("material_damping_s", stated::kMaterialDamping);
  robot.leg_mass_kg = leg.OptionalNumber("mass_kg", stated::kLegMass).value_or(0);
}

void ReadLeg(const YamlCursor& leg, RobotSpec& robot) {
  const auto type = leg.Optional("type");
  robot.straight_legs = type && type->Choice({"arc", "straight"}) == 1;
  AllowKeysOf(leg, robot.straight_legs);
  if (robot.straight_legs) return ReadStraightLeg(leg, robot);
  robot.rest_radius_m = leg.RequiredNumber("rest_radius_m", stated::kLength);
  robot.E_Pa = leg.RequiredNumber("E_Pa", stated::kModulus);
  robot.material_damping_s = leg.RequiredNumber("material_damping_s", stated::kMaterialDamping);
  robot.clamp_m = leg.OptionalNumber("clamp_m", stated::Clamp(robot.rest_radius_m)).value_or(0);
  robot.leg_mass_kg = leg.OptionalNumber("mass_kg", stated::kLegMass).value_or(0);
  if (leg.Optional("second_moment_m4")) {
    if (const auto strip = leg.Optional("width_m"))
      strip->FailAtKey("the section is given by second_moment_m4 already",
                       "Remove one of the two.");
    robot.second_moment_m4 = leg.RequiredNumber("second_moment_m4", stated::kSecondMoment);
    return;
  }
  const double width = leg.RequiredNumber("width_m", Positive(10, "m"));
  const double thickness = leg.RequiredNumber("thickness_m", Positive(10, "m"));
  robot.second_moment_m4 = width * thickness * thickness * thickness / 12;
  if (!stated::kSecondMoment.Contains(robot.second_moment_m4))
    leg.FailAtKey("width_m thickness_m^3 / 12 must be positive", "Check the unit: m is meant.");
}

}  // namespace

const std::vector<std::string>& RobotKeys() {
  static const std::vector<std::string> kKeys = {"pitch_inertia_kg_m2",
                                                 "centre_of_mass_m",
                                                 "friction",
                                                 "fall_height_m",
                                                 "pitch_limit_rad",
                                                 "motor",
                                                 "leg",
                                                 "legs"};
  return kKeys;
}

RobotSpec ReadRobot(const YamlCursor& mechanism) {
  RobotSpec robot;
  robot.pitch_inertia_kg_m2 =
      mechanism.RequiredNumber("pitch_inertia_kg_m2", stated::kPitchInertia);
  if (const auto com = mechanism.Optional("centre_of_mass_m"))
    ReadPlace(*com, robot.com_x_m, robot.com_y_m);
  robot.friction = mechanism.OptionalNumber("friction", stated::kFriction);
  robot.pitch_limit_rad = mechanism.OptionalNumber("pitch_limit_rad", Positive(3.1, "rad"));
  ReadMotor(mechanism.Required("motor", "a block with rotor_inertia_kg_m2 and the gains"), robot);
  ReadLeg(mechanism.Required("leg",
                             "a block with rest_radius_m, E_Pa, the section and "
                             "material_damping_s"),
          robot);
  const YamlCursor legs =
      mechanism.Required("legs", "a list, hindmost first, as [{hip_m: [-0.1, 0]}]");
  for (const YamlCursor& item : legs.Items(1)) {
    item.AllowOnly({"hip_m", "E_Pa"});
    RobotLegSpec leg;
    ReadPlace(item.Required("hip_m", "the hip in the body frame, [x, y]"), leg.hip_x_m,
              leg.hip_y_m);
    if (const auto modulus = item.Optional("E_Pa"); modulus && robot.straight_legs)
      modulus->FailAtKey("is of a half circle, and these legs are straight",
                         "Remove it: straight legs are alike but for the effect leg_stiffness_1.");
    leg.E_Pa = item.OptionalNumber("E_Pa", stated::kModulus);
    robot.legs.push_back(leg);
  }
  if (robot.legs.size() > kMostLegs)
    legs.Fail("must have at most 4 legs, seen from the side",
              "Legs that move together are one, with the sum of their widths.");
  return robot;
}

MotorsSpec ReadMotors(const YamlCursor& cursor) {
  MotorsSpec motors;
  motors.kind = static_cast<MotorControl>(cursor.Required("type", "locked, held, clock or recorded")
                                              .Choice({"locked", "held", "clock", "recorded"}));
  if (motors.kind == MotorControl::kRecorded) {
    cursor.AllowOnly({"type", "angles_rad", "rates_rad_per_s"});
    if (const auto angles = cursor.Optional("angles_rad"))
      motors.angles_rad = ReadNumbers(*angles, stated::kAngle);
    if (const auto rates = cursor.Optional("rates_rad_per_s")) {
      motors.rates_rad_per_s = ReadNumbers(*rates, Within(1e4, "rad/s"));
      if (motors.rates_rad_per_s.size() != motors.angles_rad.size())
        rates->Fail("must have one rate for each angle of angles_rad",
                    "Give angles_rad and rates_rad_per_s, one of each a leg, or neither.");
    }
    return motors;
  }
  if (motors.kind != MotorControl::kClock) {
    cursor.AllowOnly({"type", "angles_rad"});
    motors.angles_rad =
        ReadNumbers(cursor.Required("angles_rad", "a list, one angle a leg"), stated::kAngle);
    return motors;
  }
  cursor.AllowOnly({"type", "period_s", "duty", "sweep_rad", "offset_rad", "phases"});
  motors.period_s = cursor.RequiredNumber("period_s", stated::kPeriod);
  motors.duty = cursor.RequiredNumber("duty", stated::kDuty);
  motors.sweep_rad = cursor.RequiredNumber("sweep_rad", stated::kSweep);
  motors.offset_rad = cursor.OptionalNumber("offset_rad", stated::kAngle).value_or(0);
  motors.phases =
      ReadNumbers(cursor.Required("phases", "a list, one share of a turn a leg"), stated::kPhase);
  return motors;
}

void CheckMotors(const YamlCursor& owner, const MechanismSpec& mechanism,
                 const std::optional<ControllerSpec>& controller,
                 const std::optional<StateSpec>& initial) {
  const bool robot = mechanism.type == MechanismKind::kRobot;
  const bool motors = controller && controller->motors;
  if (robot && !motors)
    owner.Fail("a robot needs a controller that says what its motors do",
               "Add controller: {type: held, angles_rad: [0.5, 0.5]}.");
  if (!robot && motors)
    owner.Fail("a controller with a type is that of a robot's motors",
               "Give kp_N_s and v_des_m_per_s, or make the mechanism a robot.");
  if (!robot && initial && (initial->pitch_rad || initial->pitch_rate_rad_per_s))
    owner.Fail("only a robot pitches", "Remove pitch_rad and pitch_rate_rad_per_s of initial.");
  if (!robot) return;
  const MotorsSpec& m = *controller->motors;
  const bool may_be_absent = m.kind == MotorControl::kRecorded && m.angles_rad.empty();
  const std::size_t given = m.kind == MotorControl::kClock ? m.phases.size() : m.angles_rad.size();
  if (given != mechanism.robot.legs.size() && !may_be_absent)
    owner.Fail("the controller has " + std::to_string(given) + " angles or phases, and the robot " +
                   std::to_string(mechanism.robot.legs.size()) + " legs",
               "Give one for each leg, hindmost first.");
  if (initial && initial->mode != StartMode::kFlight)
    owner.Fail("a robot begins in flight", "Remove mode and contact_x_m of initial.");
}

void CheckRobotInputs(const std::string& place, const std::string& path,
                      const MechanismSpec& mechanism,
                      const std::optional<ControllerSpec>& controller,
                      const std::vector<InputSpec>& inputs) {
  const int legs = static_cast<int>(mechanism.robot.legs.size());
  const MotorsSpec& motors = *controller->motors;
  const bool recorded = motors.kind == MotorControl::kRecorded;
  const std::string key = path + "inputs.";
  for (const InputSpec& input : inputs) {
    const auto fail = [&](const std::string& rule, const std::string& remedy) {
      throw InputError({input.origin.place, key + InfoOf(input.id).key, rule, remedy});
    };
    const int motor = MotorOf(input.id);
    if (input.id == InputKind::kHipTorque)
      fail("a robot has a motor at each hip", "Say which: hip_torque_1_N_m, the hindmost.");
    if (input.id == InputKind::kLegAngle)
      fail("a robot has a motor at each hip", "Say which: leg_angle_1_rad, the hindmost.");
    if (motor >= legs)
      fail("the robot has " + std::to_string(legs) + (legs == 1 ? " leg" : " legs"), "Remove it.");
    if (motor >= 0 && !recorded)
      fail(std::string("the motors follow a controller of type ") + NameOf(motors.kind) +
               ", and a log drives this one too",
           "Write controller: {type: recorded}, or remove the input.");
  }
  if (!recorded) return;
  for (int motor = 0; motor < legs; ++motor) {
    const InputInfo& torque = InfoOf(OfMotor(InputKind::kHipTorque1, motor));
    const InputInfo& angle = InfoOf(OfMotor(InputKind::kLegAngle1, motor));
    const bool told = FindInput(inputs, OfMotor(InputKind::kHipTorque1, motor)) != nullptr;
    const bool follows = FindInput(inputs, OfMotor(InputKind::kLegAngle1, motor)) != nullptr;
    const std::string both = std::string(torque.key) + " and " + angle.key;
    if (told && follows)
      throw InputError({place, key + both, "both drive one motor", "Remove one of the two."});
    if (!told && !follows)
      throw InputError({place, key + torque.key,
                        "is absent, and so is " + std::string(angle.key) +
                            ": nothing drives motor " + std::to_string(motor + 1),
                        "Add one of the two to `inputs`: the torque the motor was told, or the "
                        "angle its controller followed."});
    if (told && motors.angles_rad.empty())
      throw InputError({place, path + "controller.angles_rad",
                        std::string("is absent, and a torque drives motor ") +
                            std::to_string(motor + 1) + ": where does it begin?",
                        "Add angles_rad, the motors' angles at the first row, one a leg."});
  }
}

}  // namespace hoplab
