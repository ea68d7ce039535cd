#include "datasets/write_dataset.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/check.h"
#include "base/text.h"
#include "base/units.h"
#include "datasets/read_spec.h"

namespace hoplab {
namespace {

// One `key: value` of a block; `group` is the block below it stands in, empty for none.
struct Field {
  std::string group;
  std::string key;
  std::string value;
  bool operator==(const Field&) const = default;
};
using Fields = std::vector<Field>;

// The shortest degrees that DegToRad turns into exactly this angle; the nearest where no double
// does.
std::string FormatDegrees(double angle_rad) {
  const double nearest = RadToDeg(angle_rad);
  std::optional<std::string> best;
  double candidate = nearest;
  constexpr int kReach = 4;  // DegToRad and RadToDeg round three times between them
  for (int i = 0; i < kReach; ++i) candidate = std::nextafter(candidate, -1e9);
  for (int i = 0; i <= 2 * kReach; ++i) {
    const std::string text = FormatDouble(candidate);
    if (DegToRad(candidate) == angle_rad && (!best || text.size() < best->size())) best = text;
    candidate = std::nextafter(candidate, 1e9);
  }
  return best.value_or(FormatDouble(nearest));
}

void AddOptional(Fields* fields, const std::string& group, const std::string& key,
                 const std::optional<double>& value) {
  if (value) fields->push_back({group, key, FormatDouble(*value)});
}

void AddCLeg(const CLegSpec& leg, Fields* fields) {
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

// All keys of a variant, {rolling: implicit, ...}: written over another one it replaces all of it.
std::string VariantText(const ThesisVariant& variant) {
  std::string text = "{";
  for (const VariantKey& key : VariantKeys()) {
    if (text.size() > 1) text += ", ";
    text += std::string(key.key) + ": " + std::string(key.words[key.get(variant)]);
  }
  return text + "}";
}
// A straight leg takes one of them only.
std::string TorqueSignText(const ThesisVariant& variant) {
  const VariantKey& key = VariantKeys().back();
  return "{" + std::string(key.key) + ": " + std::string(key.words[key.get(variant)]) + "}";
}

std::string ListText(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? ", " : "") + FormatDouble(value);
  return text + "]";
}

void AddRobot(const MechanismSpec& m, Fields* fields) {
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
  add("leg", "rest_radius_m", robot.rest_radius_m);
  add("leg", "E_Pa", robot.E_Pa);
  add("leg", "second_moment_m4", robot.second_moment_m4);
  add("leg", "material_damping_s", robot.material_damping_s);
  add("leg", "clamp_m", robot.clamp_m);
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

Fields MechanismFields(const MechanismSpec& m) {
  Fields fields = {{"", "type", MechanismTypeName(m.type)},
                   {"", "body_mass_kg", FormatDouble(m.body_mass_kg)},
                   {"", "gravity_m_per_s2", FormatDouble(m.gravity_m_per_s2)}};
  if (m.on_guide) fields.push_back({"", "guide", "vertical"});
  if (m.type == MechanismType::kBall) {
    fields.push_back({"ball", "radius_m", FormatDouble(m.ball.radius_m)});
    fields.push_back({"ball", "restitution", FormatDouble(m.ball.restitution)});
    fields.push_back({"ball", "tangential_loss", FormatDouble(m.ball.tangential_loss)});
    return fields;
  }
  if (m.type == MechanismType::kRobot) {
    AddRobot(m, &fields);
    return fields;
  }
  fields.push_back({"", "liftoff", LiftoffName(m.liftoff)});
  AddOptional(&fields, "", "fall_height_m", m.fall_height_m);
  AddOptional(&fields, "", "toe_mass_kg", m.toe_mass_kg);
  if (m.type == MechanismType::kCLeg) {
    AddCLeg(m.c_leg, &fields);
  } else {
    const StraightLegSpec& leg = m.straight_leg;
    fields.push_back({"leg", "rest_length_m", FormatDouble(leg.rest_length_m)});
    fields.push_back({"leg", "stiffness_N_per_m", FormatDouble(leg.stiffness_N_per_m)});
    fields.push_back({"leg", "damping_N_s_per_m", FormatDouble(leg.damping_N_s_per_m)});
  }
  if (m.variant != ThesisVariant()) {
    const bool is_c_leg = m.type == MechanismType::kCLeg;
    fields.push_back(
        {"leg", "variant", is_c_leg ? VariantText(m.variant) : TorqueSignText(m.variant)});
  }
  if (m.placement) {
    fields.push_back({"placement", "kp_N_m_per_rad", FormatDouble(m.placement->kp_N_m_per_rad)});
    fields.push_back(
        {"placement", "kd_N_m_s_per_rad", FormatDouble(m.placement->kd_N_m_s_per_rad)});
  }
  return fields;
}

Fields MotorsFields(const MotorsSpec& motors) {
  static const char* const kKinds[] = {"locked", "held", "clock"};
  Fields fields = {{"", "type", kKinds[static_cast<std::size_t>(motors.kind)]}};
  if (motors.kind != MotorsSpec::Kind::kClock) {
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

Fields ControllerFields(const ControllerSpec& controller) {
  if (controller.motors) return MotorsFields(*controller.motors);
  Fields fields = {{"", "kp_N_s", FormatDouble(controller.kp_N_s)},
                   {"", "v_des_m_per_s", FormatDouble(controller.v_des_m_per_s)}};
  AddOptional(&fields, "", "torque_limit_N_m", controller.torque_limit_N_m);
  return fields;
}

Fields StateFields(const StateSpec& state) {
  Fields fields;
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

const Field* FindField(const Fields& fields, const Field& like) {
  for (const Field& field : fields)
    if (field.group == like.group && field.key == like.key) return &field;
  return nullptr;
}

// What put over `base` gives `wanted`; null where `wanted` lacks a key of `base`.
Fields Difference(const Fields& base, const Fields& wanted) {
  Fields difference;
  for (const Field& field : base)
    if (FindField(wanted, field) == nullptr) difference.push_back({field.group, field.key, "null"});
  // A block without any of its keys is no block.
  const bool no_placement = FindField(wanted, {"placement", "kp_N_m_per_rad", ""}) == nullptr;
  if (no_placement) {
    std::erase_if(difference, [](const Field& field) { return field.group == "placement"; });
    if (FindField(base, {"placement", "kp_N_m_per_rad", ""}) != nullptr)
      difference.push_back({"", "placement", "null"});
  }
  for (const Field& field : wanted) {
    const Field* present = FindField(base, field);
    if (present == nullptr || present->value != field.value) difference.push_back(field);
  }
  return difference;
}

// {a: 1, leg: {b: 2}}
std::string Flow(const Fields& fields) {
  std::string text = "{";
  std::string group;
  bool first = true;
  for (const Field& field : fields) {
    if (field.group != group && !group.empty()) text += "}";
    if (!first) text += ", ";
    if (field.group != group && !field.group.empty()) text += field.group + ": {";
    group = field.group;
    text += field.key + ": " + field.value;
    first = false;
  }
  return text + (group.empty() ? "}" : "}}");
}

Fields Grouped(const Fields& fields) {
  Fields sorted;
  for (const char* group : {"", "leg", "ball", "placement", "motor"})
    for (const Field& field : fields)
      if (field.group == group) sorted.push_back(field);
  return sorted;
}

Fields ClockFields(const ClockSpec& clock) {
  Fields fields = {{"", "offset_s", FormatDouble(clock.offset_s)}};
  AddOptional(&fields, "", "sigma_s", clock.sigma_s);
  if (clock.per_trial) fields.push_back({"", "per", "trial"});
  return fields;
}

// All keys of each: written over another one they replace all of it.
Fields InputFields(const std::vector<InputSpec>& inputs) {
  Fields fields;
  for (const InputSpec& input : inputs) {
    const std::string name = InputName(input.id);
    const auto optional = [](const std::optional<double>& value) {
      return value ? FormatDouble(*value) : std::string("null");
    };
    fields.push_back({name, "column", QuotedYaml(input.column)});
    fields.push_back({name, "hold", input.held ? "previous" : "linear"});
    fields.push_back({name, "delay_s", FormatDouble(input.delay_s)});
    fields.push_back({name, "delay_sigma_s", optional(input.delay_sigma_s)});
    fields.push_back({name, "scale", FormatDouble(input.scale)});
    fields.push_back({name, "scale_sigma", optional(input.scale_sigma)});
    fields.push_back({name, "clock", input.clock.empty() ? "null" : QuotedYaml(input.clock)});
  }
  return fields;
}

// The lines of a trial's touch-down angles; those read from a column are read again.
std::string AnglesText(const Trial& trial) {
  if (FindInput(trial.inputs, InputId::kLegAngle) != nullptr) return "";
  if (trial.mechanism.type == MechanismType::kRobot) return "";
  std::string angle = FormatDegrees(trial.touchdown_angle_rad);
  const std::vector<double>& each = trial.touchdown_angles_rad;
  const bool alike = std::all_of(each.begin(), each.end(),
                                 [&](double a) { return a == trial.touchdown_angle_rad; });
  if (trial.touchdown_from_leg_angle) {
    angle = "{from: leg_angle}";
  } else if (!each.empty() && !(alike && trial.touchdown_angle_sigma_rad)) {
    angle = "[";
    for (const double a : each) angle += (angle.size() > 1 ? ", " : "") + FormatDegrees(a);
    angle += "]";
  }
  std::string text = "    touchdown_angle_deg: " + angle + "\n";
  if (trial.touchdown_angle_sigma_rad)
    text +=
        "    touchdown_angle_sigma_deg: " + FormatDegrees(*trial.touchdown_angle_sigma_rad) + "\n";
  return text;
}

void AppendTrial(const Trial& trial, const Dataset& dataset, std::string* text) {
  *text += "  - file: " + QuotedYaml(trial.file) + "\n";
  *text += std::string("    role: ") + RoleName(trial.role) + "\n";
  *text += AnglesText(trial);
  const Fields mechanism =
      Difference(MechanismFields(dataset.mechanism), MechanismFields(trial.mechanism));
  if (!mechanism.empty()) *text += "    mechanism: " + Flow(Grouped(mechanism)) + "\n";
  if (trial.controller && trial.controller != dataset.controller) {
    const Fields base = dataset.controller ? ControllerFields(*dataset.controller) : Fields{};
    *text +=
        "    controller: " + Flow(Difference(base, ControllerFields(*trial.controller))) + "\n";
  } else if (!trial.controller && dataset.controller) {
    *text += "    controller: null\n";
  }
  if (trial.inputs != dataset.inputs) {
    Fields inputs = InputFields(trial.inputs);
    for (const InputSpec& input : dataset.inputs)
      if (FindInput(trial.inputs, input.id) == nullptr)
        inputs.insert(inputs.begin(), {"", InputName(input.id), "null"});
    *text += "    inputs: " + Flow(inputs) + "\n";
  }
  if (trial.initial) *text += "    initial: " + Flow(StateFields(*trial.initial)) + "\n";
  if (trial.initial_sigma)
    *text += "    initial_sigma: " + Flow(StateFields(*trial.initial_sigma)) + "\n";
}

// {gravity_scale: none, boom_inertia: {mu_x: none, mu_y: {at_most: 0.1}}}
std::string KnownText(const std::vector<KnownSpec>& known) {
  std::string text = "{", open;
  for (const KnownSpec& k : known) {
    const std::string size =
        k.at_most ? "{at_most: " + FormatDouble(*k.at_most) + "}" : std::string("none");
    const bool goes_on = !k.parameter.empty() && k.effect == open;
    if (!goes_on && !open.empty()) text += "}";
    if (text.size() > 1) text += ", ";
    if (!goes_on) text += QuotedYaml(k.effect) + ": " + (k.parameter.empty() ? size : "{");
    if (!k.parameter.empty()) text += QuotedYaml(k.parameter) + ": " + size;
    open = k.parameter.empty() ? "" : k.effect;
  }
  return text + (open.empty() ? "}" : "}}");
}

std::string FormatYaml(const Dataset& dataset) {
  std::string text = "format: hoplab-dataset/1\nname: " + QuotedYaml(dataset.name) + "\n";
  if (!dataset.title.empty()) text += "title: " + QuotedYaml(dataset.title) + "\n";
  const SourceSpec& source = dataset.source;
  if (source.kind != SourceKind::kUnstated) {
    text += "source:\n";
    text += source.kind == SourceKind::kRecorded ? "  kind: recorded\n" : "  kind: simulated\n";
    if (!source.by.empty()) text += "  by: " + QuotedYaml(source.by) + "\n";
    if (!source.licence.empty()) text += "  licence: " + QuotedYaml(source.licence) + "\n";
    if (!source.note.empty()) text += "  note: " + QuotedYaml(source.note) + "\n";
  }
  text += "mechanism: " + Flow(Grouped(MechanismFields(dataset.mechanism))) + "\n";
  if (dataset.controller)
    text += "controller: " + Flow(ControllerFields(*dataset.controller)) + "\n";
  text += "channels:\n";
  for (const ChannelSpec& channel : dataset.channels)
    text += std::string("  ") + ChannelName(channel.id) +
            ": {sigma: " + (channel.sigma ? FormatDouble(*channel.sigma) : "estimate") +
            (channel.clock.empty() ? "" : ", clock: " + QuotedYaml(channel.clock)) + "}\n";
  for (const ClockSpec& clock : dataset.clocks)
    text += (&clock == &dataset.clocks.front() ? "clocks:\n  " : "  ") + QuotedYaml(clock.name) +
            ": " + Flow(ClockFields(clock)) + "\n";
  if (!dataset.inputs.empty()) text += "inputs: " + Flow(InputFields(dataset.inputs)) + "\n";
  if (!dataset.known.empty()) text += "known: " + KnownText(dataset.known) + "\n";
  text += "trials:\n";
  for (const Trial& trial : dataset.trials) AppendTrial(trial, dataset, &text);
  return text;
}

}  // namespace

std::string QuotedYaml(const std::string& text) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte == 0x7F) {
      out += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::map<std::string, std::string> FormatDataset(const Dataset& dataset) {
  std::map<std::string, std::string> files;
  files["dataset.yaml"] = FormatYaml(dataset);
  for (const Trial& trial : dataset.trials) {
    const bool is_new = files.emplace(trial.file, FormatTraceCsv(trial.trace)).second;
    HOPLAB_CHECK(is_new);
  }
  return files;
}

void WriteDataset(const Dataset& dataset, const std::filesystem::path& folder,
                  const WriteDatasetOptions& options) {
  const std::map<std::string, std::string> files = FormatDataset(dataset);
  OverwriteOptions overwrite;
  overwrite.force = options.force;
  overwrite.marker = "dataset.yaml";
  WriteFolderAtomically(
      folder,
      [&](const std::filesystem::path& staged) {
        for (const auto& [name, text] : files) WriteFileAtomically(staged / name, text);
      },
      overwrite);
}

}  // namespace hoplab
