#include "datasets/read_mechanism.h"

#include <algorithm>
#include <vector>

#include "base/check.h"
#include "base/text.h"
#include "datasets/key_advice.h"
#include "datasets/mechanism_ranges.h"
#include "datasets/read_robot.h"
#include "datasets/read_spec.h"

namespace hoplab {
namespace {

using Names = std::vector<std::string>;

const Names kSectionByStrip = {"width_m", "thickness_m"};
const Names kSectionByMoments = {"second_moment_m4", "area_m2"};

bool Has(const YamlCursor& cursor, const Names& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&](const std::string& key) { return cursor.Optional(key).has_value(); });
}

const Names& LegKeys(MechanismKind type) {
  static const Names kCLeg = {
      "rest_radius_m",    "E_Pa",    "G_Pa",         "width_m",           "thickness_m",
      "second_moment_m4", "area_m2", "shear_factor", "damping_N_s_per_m", "variant"};
  static const Names kStraight = {"rest_length_m", "stiffness_N_per_m", "damping_N_s_per_m",
                                  "variant"};
  static const Names kBall = {"radius_m", "restitution", "tangential_loss",
                              "air_density_kg_per_m3"};
  return type == MechanismKind::kCLeg ? kCLeg : type == MechanismKind::kBall ? kBall : kStraight;
}

// Says so when an unknown key of a leg or ball block is one of another mechanism.
void AllowKeysOf(MechanismKind type, const YamlCursor& cursor) {
  for (const auto& [key, value] : cursor.Entries(0)) {
    const Names& own = LegKeys(type);
    if (std::find(own.begin(), own.end(), key) != own.end()) continue;
    for (const MechanismKind other :
         {MechanismKind::kCLeg, MechanismKind::kStraightLeg, MechanismKind::kBall}) {
      const Names& names = LegKeys(other);
      if (std::find(names.begin(), names.end(), key) != names.end())
        value.FailAtKey(std::string("unknown key: it belongs to a ") + NameOf(other) +
                            " and this mechanism is a " + NameOf(type),
                        "Known: " + Join(own) + ".");
    }
  }
  cursor.AllowOnly(LegKeys(type));
}

void ReadSection(const YamlCursor& cursor, CLegSpec* leg) {
  const bool by_strip = Has(cursor, kSectionByStrip);
  const bool by_moments = Has(cursor, kSectionByMoments);
  const std::string rule =
      "the section is given by width_m and thickness_m or by second_moment_m4 and area_m2";
  if (by_strip && by_moments)
    cursor.FailAtKey(rule + ", not by both", "Remove one of the two pairs.");
  if (!by_strip && !by_moments)
    cursor.FailAtKey(rule + ", and neither stands here", "Add one of the two pairs.");
  if (by_strip) {
    const double width = cursor.RequiredNumber("width_m", Positive(10, "m"));
    const double thickness = cursor.RequiredNumber("thickness_m", Positive(10, "m"));
    leg->width_m = width;
    leg->thickness_m = thickness;
    leg->second_moment_m4 = width * thickness * thickness * thickness / 12;
    leg->area_m2 = width * thickness;
    const Range& moment = stated::kSecondMoment;
    if (!moment.Contains(leg->second_moment_m4))
      cursor.FailAtKey("width_m thickness_m^3 / 12 must be in " + moment.Text(),
                       "Check the unit: m is meant.");
  } else {
    leg->second_moment_m4 = cursor.RequiredNumber("second_moment_m4", stated::kSecondMoment);
    leg->area_m2 = cursor.RequiredNumber("area_m2", stated::kArea);
  }
}

CLegSpec ReadCLeg(const YamlCursor& cursor) {
  CLegSpec leg;
  leg.rest_radius_m = cursor.RequiredNumber("rest_radius_m", stated::kLength);
  leg.E_Pa = cursor.RequiredNumber("E_Pa", stated::kModulus);
  leg.G_Pa = cursor.RequiredNumber("G_Pa", stated::kModulus);
  ReadSection(cursor, &leg);
  leg.shear_factor =
      cursor.OptionalNumber("shear_factor", stated::kShearFactor).value_or(leg.shear_factor);
  leg.damping_N_s_per_m = cursor.RequiredNumber("damping_N_s_per_m", stated::kDamping);
  return leg;
}

StraightLegSpec ReadStraightLeg(const YamlCursor& cursor) {
  StraightLegSpec leg;
  leg.rest_length_m = cursor.RequiredNumber("rest_length_m", stated::kLength);
  leg.stiffness_N_per_m = cursor.RequiredNumber("stiffness_N_per_m", stated::kStiffness);
  leg.damping_N_s_per_m = cursor.RequiredNumber("damping_N_s_per_m", stated::kDamping);
  return leg;
}

BallSpec ReadBall(const YamlCursor& cursor) {
  BallSpec ball;
  ball.radius_m = cursor.RequiredNumber("radius_m", stated::kLength);
  ball.restitution = cursor.RequiredNumber("restitution", stated::kFraction);
  ball.tangential_loss = cursor.RequiredNumber("tangential_loss", stated::kFraction);
  ball.air_density_kg_per_m3 = cursor.OptionalNumber("air_density_kg_per_m3", stated::kDensity);
  return ball;
}

// The readings of the published law under `variant` of a leg's block.
ThesisReading ReadThesisReading(const YamlCursor& leg, MechanismKind type) {
  ThesisReading reading;
  const std::optional<YamlCursor> block = leg.Optional("variant");
  if (!block) return reading;
  Names known;
  for (const ReadingKey& key : ReadingKeys()) known.emplace_back(key.key);
  block->AllowOnly(known);
  for (const ReadingKey& key : ReadingKeys()) {
    const std::optional<YamlCursor> value = block->Optional(key.key);
    if (!value) continue;
    if (type == MechanismKind::kStraightLeg && key.key != "torque_sign")
      value->FailAtKey("a straight leg neither rolls nor bends: it has no such variant",
                       "Remove it; a straight leg knows torque_sign alone.");
    key.set(reading, static_cast<int>(value->Choice({key.words.begin(), key.words.end()})));
  }
  return reading;
}

void ReadLegOptions(const YamlCursor& cursor, MechanismSpec* mechanism) {
  if (const auto liftoff = cursor.Optional("liftoff"))
    mechanism->liftoff = static_cast<LiftoffRule>(liftoff->Choice({"zero_force", "rest_length"}));
  mechanism->fall_height_m = cursor.OptionalNumber("fall_height_m", NonNegative(100, "m"));
  mechanism->toe_mass_kg = cursor.OptionalNumber("toe_mass_kg", stated::kToeMass);
  if (mechanism->toe_mass_kg.value_or(0) > 0 && mechanism->liftoff == LiftoffRule::kRestLength)
    cursor.Required("liftoff", "")
        .Fail(
            "is a rule for massless legs: a toe with a mass leaves the ground when the leg lifts "
            "it",
            "Remove liftoff or toe_mass_kg.");
  const std::optional<YamlCursor> placement = cursor.Optional("placement");
  if (!placement) return;
  if (!mechanism->toe_mass_kg)
    placement->FailAtKey("only a leg with a toe mass is placed by a torque",
                         "Add toe_mass_kg or remove this block.");
  placement->AllowOnly({"kp_N_m_per_rad", "kd_N_m_s_per_rad"});
  mechanism->placement =
      PlacementSpec{placement->RequiredNumber("kp_N_m_per_rad", stated::kMotorKp),
                    placement->RequiredNumber("kd_N_m_s_per_rad", stated::kMotorKd)};
}

YamlNode MergeMechanism(const YamlNode& base, const YamlNode& overlay) {
  YamlNode merged_base = base;
  const YamlNode* leg = overlay.Find("leg");
  YamlNode* base_leg = merged_base.Find("leg");
  if (leg != nullptr && base_leg != nullptr) {
    const YamlCursor cursor(*leg, "");
    const bool is_block = leg->kind == YamlNode::Kind::kMap;
    if (is_block && Has(cursor, kSectionByMoments))
      for (const std::string& key : kSectionByStrip) base_leg->Erase(key);
    if (is_block && Has(cursor, kSectionByStrip))
      for (const std::string& key : kSectionByMoments) base_leg->Erase(key);
  }
  return MergeYaml(std::move(merged_base), overlay);
}

MechanismSpec ReadRobotMechanism(const YamlCursor& cursor) {
  Names known = {"type", "body_mass_kg", "gravity_m_per_s2"};
  known.insert(known.end(), RobotKeys().begin(), RobotKeys().end());
  cursor.AllowOnly(known);
  MechanismSpec mechanism;
  mechanism.type = MechanismKind::kRobot;
  mechanism.body_mass_kg = cursor.RequiredNumber("body_mass_kg", stated::kMass);
  mechanism.gravity_m_per_s2 = cursor.RequiredNumber("gravity_m_per_s2", stated::kGravity);
  mechanism.fall_height_m = cursor.OptionalNumber("fall_height_m", NonNegative(100, "m"));
  mechanism.robot = ReadRobot(cursor);
  return mechanism;
}

}  // namespace

MechanismSpec ReadMechanism(const YamlCursor& cursor) {
  MechanismSpec mechanism;
  mechanism.type =
      static_cast<MechanismKind>(cursor.Required("type", "c_leg, straight_leg, ball or robot")
                                     .Choice({"c_leg", "straight_leg", "ball", "robot"}));
  if (mechanism.type == MechanismKind::kRobot) return ReadRobotMechanism(cursor);
  const bool is_ball = mechanism.type == MechanismKind::kBall;
  const std::string block_key = is_ball ? "ball" : "leg";
  Names known = {"type", "body_mass_kg", "gravity_m_per_s2", "guide", block_key};
  if (!is_ball) known.insert(known.end(), {"liftoff", "fall_height_m", "toe_mass_kg", "placement"});
  cursor.AllowOnly(known);
  mechanism.body_mass_kg = cursor.RequiredNumber("body_mass_kg", stated::kMass);
  mechanism.gravity_m_per_s2 = cursor.RequiredNumber("gravity_m_per_s2", stated::kGravity);
  if (const auto guide = cursor.Optional("guide"))
    mechanism.on_guide = guide->Choice({"none", "vertical"}) == 1;
  const YamlCursor block =
      cursor.Required(block_key, "a block with " + Join(LegKeys(mechanism.type)));
  AllowKeysOf(mechanism.type, block);
  switch (mechanism.type) {
    case MechanismKind::kCLeg:
      mechanism.c_leg = ReadCLeg(block);
      break;
    case MechanismKind::kStraightLeg:
      mechanism.straight_leg = ReadStraightLeg(block);
      break;
    case MechanismKind::kBall:
      mechanism.ball = ReadBall(block);
      break;
    case MechanismKind::kRobot:
      break;  // read above
  }
  if (!is_ball) {
    mechanism.reading = ReadThesisReading(block, mechanism.type);
    ReadLegOptions(cursor, &mechanism);
  }
  return mechanism;
}

MechanismSpec ReadTrialMechanism(const YamlCursor& item, const YamlNode& base_node,
                                 const MechanismSpec& base) {
  const std::optional<YamlCursor> own = item.Optional("mechanism");
  if (!own) return base;
  const YamlNode merged = MergeMechanism(base_node, own->node());
  const MechanismSpec mechanism = ReadMechanism(YamlCursor(merged, own->key_path()));
  if (mechanism.type != base.type)
    own->Required("type", "")
        .Fail("all trials must have the same type of mechanism",
              "Make a dataset of its own for it.");
  if (mechanism.robot.straight_legs != base.robot.straight_legs)
    own->Required("leg", "")
        .Required("type", "")
        .Fail("all trials must have the same type of legs", "Make a dataset of its own for it.");
  return mechanism;
}

}  // namespace hoplab
