#include "fitting/model_of_spec.h"

#include <algorithm>

#include "base/input_error.h"
#include "base/text.h"
#include "model/formula/formula_effect.h"

namespace hoplab {
namespace {

std::vector<std::string> LawNames(MechanismKind mechanism) {
  std::vector<std::string> names;
  for (Law law : LawsOf(mechanism)) names.emplace_back(NameOf(law));
  return names;
}

RobotParameters<double> RobotOfSpec(const RobotSpec& spec,
                                    const std::optional<ControllerSpec>& controller) {
  RobotParameters<double> p;
  p.legs = static_cast<int>(spec.legs.size());
  p.pitch_inertia = spec.pitch_inertia_kg_m2;
  p.com_x = spec.com_x_m;
  p.com_y = spec.com_y_m;
  if (spec.friction) p.friction = *spec.friction;
  if (spec.pitch_limit_rad) p.pitch_limit = *spec.pitch_limit_rad;
  p.rotor_inertia = spec.rotor_inertia_kg_m2;
  p.motor_kp = spec.kp_N_m_per_rad;
  p.motor_kd = spec.kd_N_m_s_per_rad;
  if (spec.torque_limit_N_m) p.torque_limit = *spec.torque_limit_N_m;
  p.damping = spec.material_damping_s;
  p.clamp = spec.clamp_m;
  p.leg_mass = spec.leg_mass_kg;
  p.straight_legs = spec.straight_legs;
  if (spec.straight_legs) p.lateral_stiffness = spec.lateral_stiffness_N_per_m;
  for (std::size_t i = 0; i < spec.legs.size(); ++i) {
    p.hip_x[i] = spec.legs[i].hip_x_m;
    p.hip_y[i] = spec.legs[i].hip_y_m;
    p.E[i] = spec.legs[i].E_Pa.value_or(spec.E_Pa);
    p.own_moduli = p.own_moduli || spec.legs[i].E_Pa.has_value();
  }
  if (!controller || !controller->motors) return p;
  const MotorsSpec& motors = *controller->motors;
  p.control = motors.kind;
  std::copy(motors.angles_rad.begin(), motors.angles_rad.end(), p.angle.begin());
  std::copy(motors.rates_rad_per_s.begin(), motors.rates_rad_per_s.end(), p.rate.begin());
  p.starts_at_angles = !motors.angles_rad.empty();
  std::copy(motors.phases.begin(), motors.phases.end(), p.phase.begin());
  if (motors.kind == MotorControl::kClock) {
    p.period = motors.period_s;
    p.duty = motors.duty;
    p.sweep = motors.sweep_rad;
    p.offset = motors.offset_rad;
  }
  return p;
}

}  // namespace

Parameters<double> ParametersOfSpec(const MechanismSpec& mechanism,
                                    const std::optional<ControllerSpec>& controller,
                                    double touchdown_angle_rad) {
  Parameters<double> p;
  p.m = mechanism.body_mass_kg;
  p.g = mechanism.gravity_m_per_s2;
  p.theta_td = touchdown_angle_rad;
  if (controller && !controller->motors) {
    p.kp = controller->kp_N_s;
    p.v_des = controller->v_des_m_per_s;
    if (controller->torque_limit_N_m) p.torque_limit = *controller->torque_limit_N_m;
  }
  if (mechanism.fall_height_m) p.fall_height = *mechanism.fall_height_m;
  p.on_guide = mechanism.on_guide;
  p.reading = mechanism.reading;
  p.m_toe = mechanism.toe_mass_kg.value_or(0.0);
  if (mechanism.placement) {
    p.kp_place = mechanism.placement->kp_N_m_per_rad;
    p.kd_place = mechanism.placement->kd_N_m_s_per_rad;
  }
  switch (mechanism.type) {
    case MechanismKind::kCLeg:
      p.r = mechanism.c_leg.rest_radius_m;
      p.E = mechanism.c_leg.E_Pa;
      p.G = mechanism.c_leg.G_Pa;
      p.I = mechanism.c_leg.second_moment_m4;
      p.A = mechanism.c_leg.area_m2;
      p.kappa = mechanism.c_leg.shear_factor;
      p.d = mechanism.c_leg.damping_N_s_per_m;
      break;
    case MechanismKind::kStraightLeg:
      p.l0 = mechanism.straight_leg.rest_length_m;
      p.k = mechanism.straight_leg.stiffness_N_per_m;
      p.d = mechanism.straight_leg.damping_N_s_per_m;
      break;
    case MechanismKind::kBall:
      p.radius = mechanism.ball.radius_m;
      p.restitution = mechanism.ball.restitution;
      p.tangential_loss = mechanism.ball.tangential_loss;
      p.air_density = mechanism.ball.air_density_kg_per_m3.value_or(0.0);
      break;
    case MechanismKind::kRobot:
      if (mechanism.robot.straight_legs) {
        p.l0 = mechanism.robot.rest_length_m;
        p.k = mechanism.robot.stiffness_N_per_m;
      } else {
        p.r = mechanism.robot.rest_radius_m;
        p.E = mechanism.robot.E_Pa;
        p.I = mechanism.robot.second_moment_m4;
      }
      p.robot = RobotOfSpec(mechanism.robot, controller);
      break;
  }
  return p;
}

LegMass LegMassOfSpec(const MechanismSpec& mechanism) {
  return mechanism.toe_mass_kg.value_or(0.0) > 0.0 ? LegMass::kAtToe : LegMass::kNone;
}

Eigen::Vector4d StateOfSpec(const StateSpec& s) {
  return {s.x_m, s.y_m, s.vx_m_per_s, s.vy_m_per_s};
}
StateSpec SpecOfState(const Eigen::Vector4d& s) { return {s[0], s[1], s[2], s[3]}; }
Mode ModeOfSpec(StartMode mode, MechanismKind type) {
  const bool c_leg = type == MechanismKind::kCLeg;
  switch (mode) {
    case StartMode::kRolling:
      return c_leg ? Mode::kRolling : Mode::kStance;
    case StartMode::kToe:
      return c_leg ? Mode::kToe : Mode::kStance;
    case StartMode::kStance:
      return Mode::kStance;
    case StartMode::kFlight:
      break;
  }
  return Mode::kFlight;
}
std::vector<double> InitialOf(const StateSpec& s) {
  std::vector<double> initial = {s.x_m, s.y_m, s.vx_m_per_s, s.vy_m_per_s};
  if (s.contact_x_m) initial.push_back(*s.contact_x_m);
  if (s.pitch_rad || s.pitch_rate_rad_per_s) {
    initial.push_back(s.pitch_rad.value_or(0.0));
    initial.push_back(s.pitch_rate_rad_per_s.value_or(0.0));
  }
  return initial;
}

Law ResolveLaw(const std::string& name, MechanismKind mechanism, const std::string& place) {
  if (name.empty()) return LawsOf(mechanism).front();
  const std::optional<Law> law = FindLaw(name);
  if (law && MechanismOf(*law) == mechanism) return *law;
  throw InputError({place, "law = " + Printable(name),
                    law ? "is not a law of the mechanism " + std::string(NameOf(mechanism))
                        : "is not a law hoplab knows",
                    law ? "Choose from " + Join(LawNames(mechanism)) + "."
                        : DidYouMean(name, LawNames(mechanism))});
}

void CheckReading(const ThesisReading& reading, Law law, const std::string& place) {
  if (law == Law::kThesis) return;
  ThesisReading allowed;
  allowed.torque_sign = reading.torque_sign;  // of every leg
  for (const ReadingKey& key : ReadingKeys()) {
    const int word = key.get(reading);
    if (word == key.get(allowed)) continue;
    throw InputError(
        {place,
         "mechanism.leg.variant." + std::string(key.key) + " = " + std::string(key.words[word]),
         "is a reading of the law thesis and this law is " + std::string(NameOf(law)),
         "Use the law thesis, or remove it."});
  }
}

const Effect& ResolveEffect(const std::string& name, const std::string& place,
                            std::span<const Effect* const> formulas) {
  for (const Effect* effect : formulas)
    if (effect->info.name == name) return *effect;
  if (const Effect* effect = FindEffect(name)) return *effect;
  if (IsEffectFile(name)) return EffectOfFile(ReadEffectFile(name));
  std::vector<std::string> known;
  for (const Effect* effect : formulas) known.emplace_back(effect->info.name);
  for (const Effect* effect : AllEffects()) known.emplace_back(effect->info.name);
  throw InputError({place, "effect " + Printable(name), "is not in the catalogue",
                    DidYouMean(name, known) + " `hoplab effects` lists them."});
}

namespace {

// What is wrong with a formula, where it stands in its file.
InputError AsInputError(const FormulaError& e, const EffectFile& file) {
  const FormulaSource& source = file.source;
  switch (e.of()) {
    case FormulaError::Of::kFormula: {
      const std::string picture = e.Picture(source.formula);
      const std::size_t longest = 80;
      const bool shown = !picture.empty();
      const std::string part =
          shown ? source.formula.substr(e.begin(), std::min(e.end(), source.formula.size()) -
                                                       std::min(e.begin(), source.formula.size()))
                : source.formula;
      return InputError({file.formula_origin.place,
                         part.empty() ? "formula" : "formula, " + Printable(part, longest),
                         e.rule(), e.remedy() + (shown ? "\n" + picture : "")});
    }
    case FormulaError::Of::kActsAs:
      return InputError({file.acts_as_origin.place, "acts_as = " + Printable(source.acts_as),
                         e.rule(), e.remedy()});
    case FormulaError::Of::kParameter: {
      const auto i = static_cast<std::size_t>(e.parameter());
      const std::string place =
          i < file.parameter_origins.size() ? file.parameter_origins[i].place : file.origin.place;
      return InputError(
          {place, "parameters." + Printable(source.parameters[i].name), e.rule(), e.remedy()});
    }
    case FormulaError::Of::kSource:
      break;
  }
  return InputError({file.origin.place, "", e.rule(), e.remedy()});
}

// The typical size counts from the null; of what only shapes the formula it has no sign.
void CheckTypical(const FormulaParameter& p, const std::string& place) {
  if (!p.typical) return;
  const double size = *p.typical;
  const bool within = p.null ? *p.null + size >= p.lower && *p.null + size <= p.upper
                             : std::abs(size) <= p.upper - p.lower;
  if (within) return;
  throw InputError(
      {place, "parameters." + p.name + ".typical = " + FormatDouble(size),
       "leads out of its bounds [" + FormatDouble(p.lower) + ", " + FormatDouble(p.upper) + "]",
       "Move the bounds, or give a smaller size."});
}

}  // namespace

const Effect& EffectOfFile(const EffectFile& file) {
  try {
    const Effect& effect = FormulaEffect(file.source);
    for (std::size_t i = 0; i < file.parameter_origins.size(); ++i)
      CheckTypical(file.source.parameters[i], file.parameter_origins[i].place);
    return effect;
  } catch (const FormulaError& e) {
    throw AsInputError(e, file);
  }
}

RobotLegs RobotLegsOfSpec(const MechanismSpec& mechanism) {
  return {static_cast<int>(mechanism.robot.legs.size()), mechanism.robot.straight_legs};
}

void CheckApplies(const Effect& effect, Law law, LegMass mass, const std::string& place,
                  InputSet inputs, RobotLegs robot_legs) {
  if (AppliesTo(effect, law, mass, inputs, robot_legs)) return;
  if (robot_legs.count > 0 && effect.info.robot_leg > robot_legs.count) {
    throw InputError({place, "effect " + std::string(effect.info.name),
                      "is of a leg this robot does not have",
                      "Legs are counted from the hindmost, 1."});
  }
  if (robot_legs.count > 0 && effect.info.least_legs > robot_legs.count) {
    throw InputError({place, "effect " + std::string(effect.info.name),
                      "means nothing on a robot of " + std::to_string(robot_legs.count) + " leg",
                      "Leave it out; `hoplab effects` says what there is."});
  }
  if (robot_legs.straight && effect.info.arcs_only) {
    throw InputError({place, "effect " + std::string(effect.info.name),
                      "is of half circles, and this robot's legs are straight",
                      "Leave it out; `hoplab effects` says what there is."});
  }
  if (robot_legs.count > 0 && !robot_legs.straight && effect.info.rods_only) {
    throw InputError({place, "effect " + std::string(effect.info.name),
                      "is of straight legs, and this robot's are half circles",
                      "Leave it out; `hoplab effects` says what there is."});
  }
  if (AppliesTo(effect, law, mass, kEveryInput)) {
    throw InputError({place, "effect " + std::string(effect.info.name),
                      "changes a logged input, and nothing of the kind drives these runs",
                      "Name the column under `inputs`, or leave the effect out."});
  }
  if (AppliesTo(effect, law)) {
    throw InputError({place, "effect " + std::string(effect.info.name),
                      "does not apply to a leg with a toe mass", "Leave it or toe_mass_kg out."});
  }
  const MechanismKind mechanism = MechanismOf(law);
  const std::span<const Law> laws = LawsOf(mechanism);
  const bool to_another = std::any_of(laws.begin(), laws.end(), [&](Law l) {
    return AppliesTo(effect, l, LegMass::kNone, kEveryInput);
  });
  throw InputError({place, "effect " + std::string(effect.info.name),
                    to_another
                        ? "does not apply to the law " + std::string(NameOf(law))
                        : "does not apply to the mechanism " + std::string(NameOf(mechanism)),
                    "`hoplab effects` says which do."});
}

namespace {
// Each parameter that has a null a typical size off it.
EffectSetting AtTypical(const Effect& effect) {
  EffectSetting setting = EffectSetting::Null(effect);
  for (std::size_t i = 0; i < effect.info.parameters.size(); ++i) {
    const EffectParameter& p = effect.info.parameters[i];
    if (!p.is_shape) setting.values[i] = std::clamp(p.null + p.typical, p.lower, p.upper);
  }
  return setting;
}
}  // namespace

void CheckEffectValue(const Effect& effect, int parameter, double value, const std::string& name,
                      const std::string& place) {
  const EffectParameter& info = effect.info.parameters[static_cast<std::size_t>(parameter)];
  if (value >= info.lower && value <= info.upper) return;
  throw InputError({place, name + " = " + FormatDouble(value),
                    "must be in [" + FormatDouble(info.lower) + ", " + FormatDouble(info.upper) +
                        "] " + std::string(info.unit),
                    ""});
}

std::vector<EffectSetting> ResolveEffects(const std::vector<EffectSpec>& specs, Law law,
                                          LegMass mass, InputSet inputs, RobotLegs robot_legs) {
  std::vector<EffectSetting> settings;
  for (const EffectSpec& spec : specs) {
    const Effect& effect =
        spec.formula ? EffectOfFile(*spec.formula) : ResolveEffect(spec.name, spec.origin.place);
    CheckApplies(effect, law, mass, spec.origin.place, inputs, robot_legs);
    EffectSetting setting = EffectSetting::Null(effect);
    if (spec.at_typical) setting = AtTypical(effect);
    for (const NamedNumber& given : spec.parameters) {
      const std::optional<int> index = effect.FindParameter(given.name);
      if (!index) {
        std::vector<std::string> known;
        for (const EffectParameter& p : effect.info.parameters) known.emplace_back(p.name);
        throw InputError({given.origin.place, spec.name + "." + Printable(given.name),
                          "is not a parameter of this effect", DidYouMean(given.name, known)});
      }
      CheckEffectValue(effect, *index, given.value, spec.name + "." + given.name,
                       given.origin.place);
      setting.values[*index] = given.value;
    }
    settings.push_back(setting);
  }
  return settings;
}

}  // namespace hoplab
