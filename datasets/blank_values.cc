#include "datasets/blank_values.h"

#include <optional>
#include <utility>

#include "base/input_error.h"
#include "datasets/read_spec.h"

namespace hoplab {

const char* const kTouchdownAngleHint =
    "toe ahead positive: from the set-up or a still of the film";
const char* const kHipHint = "[x, y] of its hip in m, ahead of and above the body's point";
const char* const kMotorsHint =
    "what the motors did: {type: held, angles_rad: [0.6, 0.4]}, or a clock";
const char* const kMotorAnglesHint = "where the motors begin, in rad, hindmost first";
const char* const kRobotStartHint =
    "{x_m, y_m, vx_m_per_s, vy_m_per_s, pitch_rad, pitch_rate_rad_per_s} at the first row";

const std::vector<NeededValue>& NeededValues(MechanismKind type) {
  static const std::vector<NeededValue> kCLeg = {
      {"body_mass_kg", "all that the leg carries, itself included: weigh it"},
      {"gravity_m_per_s2", "9.81, less under a counterweight"},
      {"leg.rest_radius_m", "of the unloaded leg's centre line: half the distance hip to toe"},
      {"leg.E_Pa", "Young's modulus, the start of the fit: a data sheet will do"},
      {"leg.G_Pa", "shear modulus: a data sheet"},
      {"leg.width_m", "of the strip, across the plane of motion: calliper"},
      {"leg.thickness_m", "of the strip, in the plane of motion: calliper"},
      {"leg.damping_N_s_per_m", "the start of the fit: 1 will do"},
  };
  static const std::vector<NeededValue> kStraight = {
      {"body_mass_kg", "all that the leg carries, itself included: weigh it"},
      {"gravity_m_per_s2", "9.81, less under a counterweight"},
      {"leg.rest_length_m", "hip to toe, unloaded: tape measure"},
      {"leg.stiffness_N_per_m", "of the spring, the start of the fit: a data sheet will do"},
      {"leg.damping_N_s_per_m", "the start of the fit: 1 will do"},
  };
  static const std::vector<NeededValue> kBall = {
      {"body_mass_kg", "weigh it"},
      {"gravity_m_per_s2", "9.81"},
      {"ball.radius_m", "half its diameter"},
      {"ball.restitution", "speed after over speed before a bounce, the start of the fit"},
      {"ball.tangential_loss", "share of the speed along the ground lost in a bounce: 0.1 will do"},
  };
  static const std::vector<NeededValue> kRobot = {
      {"body_mass_kg", "all of the robot: weigh it"},
      {"gravity_m_per_s2", "9.81, less under a counterweight"},
      {"pitch_inertia_kg_m2", "about the centre of mass: swing it from a hip and time it"},
      {"friction", "under the feet; without it they hold", true},
      {"motor.rotor_inertia_kg_m2", "of the rotor, times the square of the gear: a data sheet"},
      {"motor.kp_N_m_per_rad", "of the controller that holds the motor's angle"},
      {"motor.kd_N_m_s_per_rad", "likewise"},
      {"motor.torque_limit_N_m", "of each motor; without it they give any", true},
      {"leg.rest_radius_m", "half the distance from hip to toe, unloaded"},
      {"leg.E_Pa", "of the strip, the start of the fit: a data sheet will do"},
      {"leg.width_m", "of the strip, of legs that are one here the sum: calliper"},
      {"leg.thickness_m", "of the strip, in the plane of motion: calliper"},
      {"leg.material_damping_s", "the start of the fit: 0.0004 will do"},
      {"leg.clamp_m", "what the hub holds rigid of each leg; without it 0", true},
      {"leg.mass_kg", "of each leg, beside the body's: weigh it; without it 0", true},
  };
  if (type == MechanismKind::kRobot) return kRobot;
  return type == MechanismKind::kCLeg ? kCLeg : type == MechanismKind::kBall ? kBall : kStraight;
}

namespace {

// Those of a robot on straight legs: what half circles have gives way.
const std::vector<NeededValue>& NeededOfStraightLegs() {
  static const std::vector<NeededValue> kStraight = [] {
    std::vector<NeededValue> list = NeededValues(MechanismKind::kRobot);
    std::erase_if(list, [](const NeededValue& needed) {
      return needed.key.starts_with("leg.") && needed.key != "leg.material_damping_s" &&
             needed.key != "leg.mass_kg";
    });
    list.insert(
        list.end(),
        {{"leg.rest_length_m", "from hip to toe, unloaded: tape measure"},
         {"leg.stiffness_N_per_m", "along each leg, the start of the fit: press it"},
         {"leg.lateral_stiffness_N_per_m", "across it, its hip held fast: pull at its toe"}});
    return list;
  }();
  return kStraight;
}

std::optional<MechanismKind> TypeOf(const YamlNode& mechanism) {
  const YamlNode* type = mechanism.Find("type");
  if (type == nullptr) return std::nullopt;
  for (const MechanismKind t : kMechanisms)
    if (type->text == NameOf(t)) return t;
  return std::nullopt;
}

const YamlNode* FindDotted(const YamlNode& root, const std::string& key) {
  const std::size_t dot = key.find('.');
  const YamlNode* node = root.Find(key.substr(0, dot));
  if (dot == std::string::npos || node == nullptr) return node;
  return FindDotted(*node, key.substr(dot + 1));
}

bool IsBlank(const YamlNode* node) {
  return node != nullptr && node->kind == YamlNode::Kind::kNull;
}

const std::vector<NeededValue>& NeededBy(const YamlNode& mechanism, MechanismKind type) {
  const YamlNode* kind = FindDotted(mechanism, "leg.type");
  const bool straight = type == MechanismKind::kRobot && kind && kind->text == "straight";
  return straight ? NeededOfStraightLegs() : NeededValues(type);
}

void FindBlanksOfLegs(const YamlNode& mechanism, std::vector<BlankValue>* blanks) {
  const YamlNode* legs = mechanism.Find("legs");
  if (legs == nullptr) return;
  for (std::size_t i = 0; i < legs->items.size(); ++i) {
    const YamlNode* hip = legs->items[i].Find("hip_m");
    if (IsBlank(hip))
      blanks->push_back({hip->place, "mechanism.legs[" + std::to_string(i) + "].hip_m", kHipHint});
  }
}

// What each trial of a mechanism needs, and its hint.
std::vector<std::pair<std::string, const char*>> KeysOfTrials(MechanismKind type) {
  if (type == MechanismKind::kBall) return {};
  if (type != MechanismKind::kRobot) return {{"touchdown_angle_deg", kTouchdownAngleHint}};
  return {{"controller", kMotorsHint},
          {"controller.angles_rad", kMotorAnglesHint},
          {"initial", kRobotStartHint}};
}

}  // namespace

std::vector<BlankValue> FindBlankValues(const YamlNode& dataset) {
  std::vector<BlankValue> blanks;
  const YamlNode* mechanism = dataset.Find("mechanism");
  const std::optional<MechanismKind> type =
      mechanism == nullptr ? std::nullopt : TypeOf(*mechanism);
  if (!type) return blanks;
  for (const NeededValue& needed : NeededBy(*mechanism, *type)) {
    const YamlNode* node = FindDotted(*mechanism, needed.key);
    if (IsBlank(node)) blanks.push_back({node->place, "mechanism." + needed.key, needed.hint});
  }
  if (*type == MechanismKind::kRobot) FindBlanksOfLegs(*mechanism, &blanks);
  const YamlNode* trials = dataset.Find("trials");
  if (trials == nullptr) return blanks;
  for (std::size_t i = 0; i < trials->items.size(); ++i)
    for (const auto& [key, hint] : KeysOfTrials(*type)) {
      const YamlNode* node = FindDotted(trials->items[i], key);
      if (IsBlank(node))
        blanks.push_back({node->place, "trials[" + std::to_string(i) + "]." + key, hint});
    }
  return blanks;
}

void CheckNothingIsBlank(const YamlNode& dataset) {
  const std::vector<BlankValue> blanks = FindBlankValues(dataset);
  // One alone reads best as any other missing key does.
  if (blanks.size() < 2) return;
  std::string list;
  for (std::size_t i = 0; i < blanks.size(); ++i) {
    // Trials all want the same: told of the first, with the lines of the others.
    const bool likewise = i > 0 && blanks[i].hint == blanks[i - 1].hint;
    const bool second = likewise && (i < 2 || blanks[i - 2].hint != blanks[i].hint);
    const std::string line = blanks[i].place.substr(blanks[i].place.rfind(':') + 1);
    list += likewise ? (second ? ", likewise line " : ", ") + line
                     : "\n  line " + line + "  " + blanks[i].key + "  (" + blanks[i].hint + ")";
  }
  const std::string& place = blanks.front().place;
  throw InputError({place.substr(0, place.rfind(':')), "",
                    std::to_string(blanks.size()) + " values are still blank, and a fit needs them",
                    "Write each behind its key:" + list});
}

}  // namespace hoplab
