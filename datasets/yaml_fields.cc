#include "datasets/yaml_fields.h"

#include <algorithm>

#include "base/text.h"
#include "datasets/dataset.h"
#include "datasets/read_spec.h"

namespace hoplab {
namespace {

void AddCLeg(const CLegSpec& leg, YamlFields* fields) {
  const auto add = [&](const char* key, double value) {
    fields->push_back({"leg", key, FormatDouble(value)});
  };
  add("rest_radius_m", leg.rest_radius_m);
  add("E_Pa", leg.E_Pa);
  add("G_Pa", leg.G_Pa);
  if (leg.width_m && leg.thickness_m) {
    add("width_m", *leg.width_m);
    add("thickness_m", *leg.thickness_m);
  } else {
    add("second_moment_m4", leg.second_moment_m4);
    add("area_m2", leg.area_m2);
  }
  add("shear_factor", leg.shear_factor);
  add("damping_N_s_per_m", leg.damping_N_s_per_m);
}

// All keys of a reading, {rolling: implicit, ...}: written over another one it replaces all of it.
std::string ReadingText(const ThesisReading& reading) {
  std::string text = "{";
  for (const ReadingKey& key : ReadingKeys()) {
    if (text.size() > 1) text += ", ";
    text += std::string(key.key) + ": " + std::string(key.words[key.get(reading)]);
  }
  return text + "}";
}
// A straight leg takes one of them only.
std::string TorqueSignText(const ThesisReading& reading) {
  const ReadingKey& key = ReadingKeys().back();
  return "{" + std::string(key.key) + ": " + std::string(key.words[key.get(reading)]) + "}";
}

std::string ListText(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? ", " : "") + FormatDouble(value);
  return text + "]";
}

void AddRobot(const MechanismSpec& m, YamlFields* fields) {
  const RobotSpec& robot = m.robot;
  const auto add = [&](const char* group, const char* key, double value) {
    fields->push_back({group, key, FormatDouble(value)});
  };
  AddOptional(fields, "", "fall_height_m", m.fall_height_m);
  add("", "pitch_inertia_kg_m2", robot.pitch_inertia_kg_m2);
  fields->push_back({"", "centre_of_mass_m", ListText({robot.com_x_m, robot.com_y_m})});
  AddOptional(fields, "", "friction", robot.friction);
  AddOptional(fields, "", "pitch_limit_rad", robot.pitch_limit_rad);
  add("motor", "rotor_inertia_kg_m2", robot.rotor_inertia_kg_m2);
  add("motor", "kp_N_m_per_rad", robot.kp_N_m_per_rad);
  add("motor", "kd_N_m_s_per_rad", robot.kd_N_m_s_per_rad);
  AddOptional(fields, "motor", "torque_limit_N_m", robot.torque_limit_N_m);
  if (robot.straight_legs) {
    fields->push_back({"leg", "type", "straight"});
    add("leg", "rest_length_m", robot.rest_length_m);
    add("leg", "stiffness_N_per_m", robot.stiffness_N_per_m);
    add("leg", "lateral_stiffness_N_per_m", robot.lateral_stiffness_N_per_m);
  } else {
    add("leg", "rest_radius_m", robot.rest_radius_m);
    add("leg", "E_Pa", robot.E_Pa);
    add("leg", "second_moment_m4", robot.second_moment_m4);
  }
  add("leg", "material_damping_s", robot.material_damping_s);
  if (!robot.straight_legs) add("leg", "clamp_m", robot.clamp_m);
  add("leg", "mass_kg", robot.leg_mass_kg);
  std::string legs = "[";
  for (const RobotLegSpec& leg : robot.legs) {
    if (legs.size() > 1) legs += ", ";
    legs += "{hip_m: " + ListText({leg.hip_x_m, leg.hip_y_m});
    if (leg.E_Pa) legs += ", E_Pa: " + FormatDouble(*leg.E_Pa);
    legs += "}";
  }
  fields->push_back({"", "legs", legs + "]"});
}

YamlFields MotorsFields(const MotorsSpec& motors) {
  YamlFields fields = {{"", "type", NameOf(motors.kind)}};
  if (motors.kind == MotorControl::kRecorded) {
    if (motors.angles_rad.empty()) return fields;
    fields.push_back({"", "angles_rad", ListText(motors.angles_rad)});
    if (!motors.rates_rad_per_s.empty())
      fields.push_back({"", "rates_rad_per_s", ListText(motors.rates_rad_per_s)});
    return fields;
  }
  if (motors.kind != MotorControl::kClock) {
    fields.push_back({"", "angles_rad", ListText(motors.angles_rad)});
    return fields;
  }
  fields.push_back({"", "period_s", FormatDouble(motors.period_s)});
  fields.push_back({"", "duty", FormatDouble(motors.duty)});
  fields.push_back({"", "sweep_rad", FormatDouble(motors.sweep_rad)});
  fields.push_back({"", "offset_rad", FormatDouble(motors.offset_rad)});
  fields.push_back({"", "phases", ListText(motors.phases)});
  return fields;
}

const YamlField* FindField(const YamlFields& fields, const YamlField& like) {
  for (const YamlField& field : fields)
    if (field.group == like.group && field.key == like.key) return &field;
  return nullptr;
}

}  // namespace

void AddOptional(YamlFields* fields, const std::string& group, const std::string& key,
                 const std::optional<double>& value) {
  if (value) fields->push_back({group, key, FormatDouble(*value)});
}

YamlFields MechanismFields(const MechanismSpec& m) {
  YamlFields fields = {{"", "type", NameOf(m.type)},
                       {"", "body_mass_kg", FormatDouble(m.body_mass_kg)},
                       {"", "gravity_m_per_s2", FormatDouble(m.gravity_m_per_s2)}};
  if (m.on_guide) fields.push_back({"", "guide", "vertical"});
  if (m.type == MechanismKind::kBall) {
    fields.push_back({"ball", "radius_m", FormatDouble(m.ball.radius_m)});
    fields.push_back({"ball", "restitution", FormatDouble(m.ball.restitution)});
    fields.push_back({"ball", "tangential_loss", FormatDouble(m.ball.tangential_loss)});
    AddOptional(&fields, "ball", "air_density_kg_per_m3", m.ball.air_density_kg_per_m3);
    return fields;
  }
  if (m.type == MechanismKind::kRobot) {
    AddRobot(m, &fields);
    return fields;
  }
  fields.push_back({"", "liftoff", NameOf(m.liftoff)});
  AddOptional(&fields, "", "fall_height_m", m.fall_height_m);
  AddOptional(&fields, "", "toe_mass_kg", m.toe_mass_kg);
  if (m.type == MechanismKind::kCLeg) {
    AddCLeg(m.c_leg, &fields);
  } else {
    const StraightLegSpec& leg = m.straight_leg;
    fields.push_back({"leg", "rest_length_m", FormatDouble(leg.rest_length_m)});
    fields.push_back({"leg", "stiffness_N_per_m", FormatDouble(leg.stiffness_N_per_m)});
    fields.push_back({"leg", "damping_N_s_per_m", FormatDouble(leg.damping_N_s_per_m)});
  }
  if (m.reading != ThesisReading()) {
    const bool is_c_leg = m.type == MechanismKind::kCLeg;
    fields.push_back(
        {"leg", "variant", is_c_leg ? ReadingText(m.reading) : TorqueSignText(m.reading)});
  }
  if (m.placement) {
    fields.push_back({"placement", "kp_N_m_per_rad", FormatDouble(m.placement->kp_N_m_per_rad)});
    fields.push_back(
        {"placement", "kd_N_m_s_per_rad", FormatDouble(m.placement->kd_N_m_s_per_rad)});
  }
  return fields;
}

YamlFields ControllerFields(const ControllerSpec& controller) {
  if (controller.motors) return MotorsFields(*controller.motors);
  YamlFields fields = {{"", "kp_N_s", FormatDouble(controller.kp_N_s)},
                       {"", "v_des_m_per_s", FormatDouble(controller.v_des_m_per_s)}};
  AddOptional(&fields, "", "torque_limit_N_m", controller.torque_limit_N_m);
  return fields;
}

YamlFields StateFields(const StateSpec& state) {
  YamlFields fields;
  const auto add = [&](const char* key, double value) {
    if (value != kFreeSigma) fields.push_back({"", key, FormatDouble(value)});
  };
  add("x_m", state.x_m);
  add("y_m", state.y_m);
  add("vx_m_per_s", state.vx_m_per_s);
  add("vy_m_per_s", state.vy_m_per_s);
  if (state.pitch_rad) add("pitch_rad", *state.pitch_rad);
  if (state.pitch_rate_rad_per_s) add("pitch_rate_rad_per_s", *state.pitch_rate_rad_per_s);
  if (state.contact_x_m) add("contact_x_m", *state.contact_x_m);
  if (state.mode != StartMode::kFlight)
    fields.push_back({"", "mode", StartModeNames()[static_cast<std::size_t>(state.mode)]});
  return fields;
}

YamlFields Difference(const YamlFields& base, const YamlFields& wanted) {
  YamlFields difference;
  for (const YamlField& field : base)
    if (FindField(wanted, field) == nullptr) difference.push_back({field.group, field.key, "null"});
  // A block without any of its keys is no block.
  const bool no_placement = FindField(wanted, {"placement", "kp_N_m_per_rad", ""}) == nullptr;
  if (no_placement) {
    std::erase_if(difference, [](const YamlField& field) { return field.group == "placement"; });
    if (FindField(base, {"placement", "kp_N_m_per_rad", ""}) != nullptr)
      difference.push_back({"", "placement", "null"});
  }
  for (const YamlField& field : wanted) {
    const YamlField* present = FindField(base, field);
    if (present == nullptr || present->value != field.value) difference.push_back(field);
  }
  return difference;
}

std::string Flow(const YamlFields& fields) {
  std::string text = "{";
  std::string group;
  bool first = true;
  for (const YamlField& field : fields) {
    if (field.group != group && !group.empty()) text += "}";
    if (!first) text += ", ";
    if (field.group != group && !field.group.empty()) text += field.group + ": {";
    group = field.group;
    text += field.key + ": " + field.value;
    first = false;
  }
  return text + (group.empty() ? "}" : "}}");
}

YamlFields Grouped(const YamlFields& fields) {
  YamlFields sorted;
  for (const char* group : {"", "leg", "ball", "placement", "motor"})
    for (const YamlField& field : fields)
      if (field.group == group) sorted.push_back(field);
  return sorted;
}

}  // namespace hoplab
