#include "datasets/read_spec.h"

#include "base/text.h"
#include "base/units.h"
#include "datasets/key_advice.h"
#include "datasets/mechanism_ranges.h"
#include "datasets/read_robot.h"

namespace hoplab {

ControllerSpec ReadController(const YamlCursor& cursor) {
  ControllerSpec controller;
  if (cursor.Optional("type")) {
    controller.motors = ReadMotors(cursor);
    return controller;
  }
  cursor.AllowOnly({"kp_N_s", "v_des_m_per_s", "torque_limit_N_m"});
  controller.kp_N_s = cursor.RequiredNumber("kp_N_s", stated::kSpeedGain);
  controller.v_des_m_per_s = cursor.RequiredNumber("v_des_m_per_s", stated::kSpeed);
  controller.torque_limit_N_m = cursor.OptionalNumber("torque_limit_N_m", Positive(1e6, "N m"));
  return controller;
}

StateSpec ReadState(const YamlCursor& cursor) {
  cursor.AllowOnly({"x_m", "y_m", "vx_m_per_s", "vy_m_per_s", "contact_x_m", "mode", "pitch_rad",
                    "pitch_rate_rad_per_s"});
  StateSpec state = {cursor.RequiredNumber("x_m", Within(1e6, "m")),
                     cursor.RequiredNumber("y_m", Within(1e6, "m")),
                     cursor.RequiredNumber("vx_m_per_s", Within(1e4, "m/s")),
                     cursor.RequiredNumber("vy_m_per_s", Within(1e4, "m/s"))};
  state.pitch_rad = cursor.OptionalNumber("pitch_rad", Within(1e3, "rad"));
  state.pitch_rate_rad_per_s = cursor.OptionalNumber("pitch_rate_rad_per_s", Within(1e4, "rad/s"));
  state.contact_x_m = cursor.OptionalNumber("contact_x_m", Within(1e6, "m"));
  const std::optional<YamlCursor> mode = cursor.Optional("mode");
  if (mode) state.mode = static_cast<StartMode>(mode->Choice(StartModeNames()));
  if (!mode && state.contact_x_m) state.mode = StartMode::kStance;
  const bool flies = state.mode == StartMode::kFlight;
  if (flies && state.contact_x_m)
    mode->Fail("is a start in flight, which has no contact",
               "Remove contact_x_m, or say mode: stance.");
  if (!flies && !state.contact_x_m)
    mode->Fail("is a start in stance, which needs contact_x_m",
               "Add contact_x_m, the place of the ground that carries the leg.");
  return state;
}

void CheckStart(const YamlCursor& owner, const StateSpec& start, const MechanismSpec& mechanism) {
  const MechanismKind type = mechanism.type;
  if (mechanism.on_guide && start.vx_m_per_s != 0)
    owner.FailAtKey("begins with vx_m_per_s = " + FormatDouble(start.vx_m_per_s) +
                        ", and a vertical guide holds the body along the ground",
                    "Write vx_m_per_s: 0, or guide: none.");
  if (start.mode == StartMode::kFlight) return;
  const std::string rule = type == MechanismKind::kBall ? "a ball has no stance to begin in"
                                                        : "a straight leg neither rolls nor has "
                                                          "another toe: its one mode is stance";
  const bool own_modes = type == MechanismKind::kCLeg || start.mode == StartMode::kStance;
  if (type == MechanismKind::kBall || !own_modes)
    owner.Fail(
        rule, type == MechanismKind::kBall ? "Begin the record in flight." : "Write mode: stance.");
}

const std::vector<std::string>& StartModeNames() {
  static const std::vector<std::string> kNames = {"flight", "rolling", "toe", "stance"};
  return kNames;
}

StateSpec ReadStateSigma(const YamlCursor& cursor) {
  cursor.AllowOnly({"x_m", "y_m", "vx_m_per_s", "vy_m_per_s", "contact_x_m", "pitch_rad",
                    "pitch_rate_rad_per_s"});
  const auto sigma = [&](const char* key, const char* unit) {
    return cursor.OptionalNumber(key, Positive(1e6, unit)).value_or(kFreeSigma);
  };
  StateSpec known = {sigma("x_m", "m"), sigma("y_m", "m"), sigma("vx_m_per_s", "m/s"),
                     sigma("vy_m_per_s", "m/s"),
                     cursor.OptionalNumber("contact_x_m", Positive(1e6, "m"))};
  known.pitch_rad = cursor.OptionalNumber("pitch_rad", Positive(1e3, "rad"));
  known.pitch_rate_rad_per_s =
      cursor.OptionalNumber("pitch_rate_rad_per_s", Positive(1e4, "rad/s"));
  return known;
}

Range TouchdownAngleRange(MechanismKind type) {
  // A C-leg's angle is that of its tangent at the hip and reaches far beyond the upright; a
  // straight leg at 90 degrees lies on the ground.
  return {-90, type == MechanismKind::kStraightLeg ? 90.0 : 180.0, true, true, "deg"};
}

double ReadTouchdownAngle(const YamlCursor& owner, MechanismKind type) {
  const Range range = TouchdownAngleRange(type);
  const char* const key = "touchdown_angle_deg";
  if (type == MechanismKind::kRobot) {
    if (const auto given = owner.Optional(key))
      given->FailAtKey("the angles of a robot's legs are said by its controller", "Remove it.");
    return 0;
  }
  if (type == MechanismKind::kBall) return DegToRad(owner.OptionalNumber(key, range).value_or(0));
  return DegToRad(owner.RequiredNumber(key, range));
}

std::vector<ChannelSpec> ReadChannels(const YamlCursor& cursor) {
  std::vector<ChannelSpec> channels;
  for (const auto& [name, block] : cursor.Entries(1)) {
    const std::optional<Channel> id = ChannelFromName(name);
    if (!id) {
      const KeyAdvice advice = UnknownKeyAdvice(name, ChannelNames());
      block.FailAtKey(advice.rule == "unknown key" ? "is no column of the format" : advice.rule,
                      advice.remedy);
    }
    ChannelSpec channel;
    channel.id = *id;
    channel.origin.place = block.place();
    block.AllowOnly({"sigma", "clock"});
    if (const auto clock = block.Optional("clock")) channel.clock = clock->Name();
    // A contact is an event, it may go without.
    const bool may_be_absent = IsContact(*id);
    const std::optional<YamlCursor> sigma =
        may_be_absent ? block.Optional("sigma")
                      : block.Required("sigma", "1 standard deviation, or estimate");
    const Range range = SigmaRange(*id);
    const bool is_word =
        sigma && sigma->node().kind == YamlNode::Kind::kScalar && !ParseDouble(sigma->node().text);
    if (is_word && sigma->Text() != "estimate")
      sigma->Fail("must be a number in " + range.Text() + " or the word estimate",
                  "Write 1 standard deviation, or estimate.");
    if (sigma && !is_word) channel.sigma = sigma->Number(range);
    channels.push_back(channel);
  }
  return channels;
}

TrialRole ReadRole(const YamlCursor& cursor) {
  return static_cast<TrialRole>(cursor.Choice({"train", "test"}));
}

void CheckFormat(const YamlCursor& root, const std::string& expected) {
  const YamlCursor format = root.Required("format", expected);
  const std::string text = format.Text();
  if (text == expected) return;
  std::string remedy = "Write format: " + expected + ".";
  if (text == "hoplab-scenario/1")
    remedy = "This is a scenario: simulate, generate, gait, optimize and sweep read it.";
  if (text == "hoplab-dataset/1") remedy = "This is a dataset: check, fit and diagnose read it.";
  format.Fail("must be " + expected, remedy);
}

}  // namespace hoplab
