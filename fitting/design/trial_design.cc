#include "fitting/design/trial_design.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "base/input_error.h"
#include "base/text.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array<DesignSettingInfo, kDesignSettings> kInfo = {
    {{"angle", "angle_deg", "deg", kDegree},
     {"height", "height_m", "m", 1.0},
     {"speed", "speed_m_per_s", "m/s", 1.0},
     {"mass", "added_mass_kg", "kg", 1.0},
     {"throw", "throw_m_per_s", "m/s", 1.0},
     {"gain", "gain_N_s", "N s", 1.0},
     {"pitch", "pitch_deg", "deg", kDegree},
     {"leg_1", "leg_1_deg", "deg", kDegree},
     {"leg_2", "leg_2_deg", "deg", kDegree},
     {"leg_3", "leg_3_deg", "deg", kDegree},
     {"leg_4", "leg_4_deg", "deg", kDegree}}};
// What may be asked for at all, in the unit of the option: beyond it is a slip of the unit.
constexpr std::array<std::pair<double, double>, kDesignSettings> kWidest = {{{-80.0, 80.0},
                                                                             {1e-3, 100.0},
                                                                             {-100.0, 100.0},
                                                                             {0.0, 1000.0},
                                                                             {0.0, 100.0},
                                                                             {0.0, 1e6},
                                                                             {-60.0, 60.0},
                                                                             {-180.0, 180.0},
                                                                             {-180.0, 180.0},
                                                                             {-180.0, 180.0},
                                                                             {-180.0, 180.0}}};

constexpr double kMostTurn = 15.0 * kDegree;  // beyond the recorded angles
constexpr double kMostPitch = 10.0 * kDegree;
constexpr double kSteepest = 60.0 * kDegree;  // of a default range
constexpr double kSlowest = 0.5;              // m/s, where no trial has a speed
constexpr double kMostThrow = 1.0;            // m/s

struct Extent {
  double low = 0.0, high = 0.0;
  bool empty = true;
  void Add(double value) {
    low = empty ? value : std::min(low, value);
    high = empty ? value : std::max(high, value);
    empty = false;
  }
};

bool StartsInFlight(const TrialProblem& trial) {
  return trial.start_mode == Mode::kFlight && trial.start.size() >= 4;
}

bool Fits(const FitProblem& problem, ParameterId parameter) {
  return std::any_of(problem.shared.begin(), problem.shared.end(), [&](const SharedParameter& s) {
    return s.direction.of == SensitivityDirection::Of::kParameter &&
           s.direction.parameter == parameter;
  });
}

// Of a setting of one leg, which: 0 the hindmost.
std::size_t LegOf(DesignSetting setting) {
  return static_cast<std::size_t>(setting) - static_cast<std::size_t>(DesignSetting::kLeg1);
}

void Set(TrialDesign& design, DesignSetting setting, double value) {
  switch (setting) {
    case DesignSetting::kAngle:
      design.touchdown_angle = value;
      return;
    case DesignSetting::kHeight:
      design.height = value;
      return;
    case DesignSetting::kSpeed:
      design.speed = value;
      return;
    case DesignSetting::kMass:
      design.added_mass = value;
      return;
    case DesignSetting::kThrow:
      design.throw_speed = value;
      return;
    case DesignSetting::kGain:
      design.kp = value;
      return;
    case DesignSetting::kPitch:
      design.pitch = value;
      return;
    default:
      design.leg_angle[LegOf(setting)] = value;
  }
}

// Where a motor of a trial is held, or begins, where a log drives it.
double AngleOf(const TrialProblem& trial, int leg) {
  const RobotParameters<double>& robot = *trial.parameters.robot;
  if (robot.control == MotorControl::kRecorded && !robot.starts_at_angles)
    for (const DrivenColumn& column : trial.inputs)
      if (column.kind == OfMotor(InputKind::kLegAngle1, leg)) return column.values.front();
  return robot.angle[static_cast<std::size_t>(leg)];
}

// Pitch, and the angle of each motor, which is held in a trial to record unless a clock turns it.
void AddRobotRanges(const std::vector<TrialProblem>& train, std::vector<DesignRange>& ranges) {
  const RobotParameters<double>& robot = *train.front().parameters.robot;
  const int held = robot.control == MotorControl::kClock ? 0 : robot.legs;
  for (int leg = 0; leg < held; ++leg) {
    Extent angle;
    for (const TrialProblem& trial : train) angle.Add(AngleOf(trial, leg));
    const auto setting = static_cast<DesignSetting>(static_cast<int>(DesignSetting::kLeg1) + leg);
    ranges.push_back({setting, angle.low - kMostTurn, angle.high + kMostTurn});
  }
  Extent pitch;
  for (const TrialProblem& trial : train) pitch.Add(trial.start.size() > 4 ? trial.start[4] : 0.0);
  ranges.push_back({DesignSetting::kPitch, pitch.low - kMostPitch, pitch.high + kMostPitch});
}

std::string RangeText(double low, double high, const DesignSettingInfo& info) {
  return "must be a range within " + FormatDouble(low) + ":" + FormatDouble(high) + " " +
         std::string(info.unit);
}

}  // namespace

const DesignSettingInfo& InfoOf(DesignSetting setting) {
  return kInfo[static_cast<std::size_t>(setting)];
}

std::optional<DesignSetting> FindDesignSetting(std::string_view name) {
  for (int i = 0; i < kDesignSettings; ++i) {
    const auto setting = static_cast<DesignSetting>(i);
    if (InfoOf(setting).name == name) return setting;
  }
  return std::nullopt;
}

double ValueOf(const TrialDesign& design, DesignSetting setting) {
  switch (setting) {
    case DesignSetting::kAngle:
      return design.touchdown_angle;
    case DesignSetting::kHeight:
      return design.height;
    case DesignSetting::kSpeed:
      return design.speed;
    case DesignSetting::kMass:
      return design.added_mass;
    case DesignSetting::kThrow:
      return design.throw_speed;
    case DesignSetting::kGain:
      return design.kp.value_or(0.0);
    case DesignSetting::kPitch:
      return design.pitch;
    default:
      return design.leg_angle[LegOf(setting)];
  }
}

std::vector<DesignRange> DesignSpace::Searched() const {
  std::vector<DesignRange> searched;
  for (const DesignRange& range : ranges) {
    if (range.searched()) searched.push_back(range);
  }
  return searched;
}

TrialDesign DesignSpace::At(std::span<const double> point) const {
  TrialDesign design;
  design.like = like.file;
  const bool angled = std::any_of(ranges.begin(), ranges.end(), [](const DesignRange& r) {
    return r.setting == DesignSetting::kAngle;
  });
  if (!angled) design.touchdown_angle = std::numeric_limits<double>::quiet_NaN();
  design.height = like.start[1];
  design.speed = like.start[2];
  if (like.parameters.kp != 0.0) design.kp = like.parameters.kp;
  std::size_t next = 0;
  for (const DesignRange& range : ranges) {
    const double share = range.searched() ? point[next++] : 0.0;
    Set(design, range.setting, range.low + share * (range.high - range.low));
  }
  return design;
}

DesignSpace DefaultSpace(const FitProblem& problem, const std::vector<TrialProblem>& train) {
  DesignSpace space = PlainSpace(problem, train);
  for (DesignRange& range : space.ranges) {
    if (range.setting == DesignSetting::kSpeed) range.low = -range.high / 3.0;
  }
  const auto before_gain =
      std::find_if(space.ranges.begin(), space.ranges.end(),
                   [](const DesignRange& r) { return r.setting == DesignSetting::kGain; });
  std::vector<DesignRange> more;
  if (!Fits(problem, ParameterId::kM))
    more.push_back({DesignSetting::kMass, 0.0, 0.5 * space.like.parameters.m});
  more.push_back({DesignSetting::kThrow, 0.0, kMostThrow});
  space.ranges.insert(before_gain, more.begin(), more.end());
  return space;
}

DesignSpace PlainSpace(const FitProblem& problem, const std::vector<TrialProblem>& train) {
  DesignSpace space{train[train.size() / 2], {}};
  Extent angle, height, speed, gain;
  for (const TrialProblem& trial : train) {
    angle.Add(trial.parameters.theta_td);
    gain.Add(trial.parameters.kp);
    if (!StartsInFlight(trial) && trial.file != space.like.file) continue;
    height.Add(trial.start[1]);
    speed.Add(std::abs(trial.start[2]));
  }
  if (TraitsOf(problem.law).lands_leg_by_leg) {
    AddRobotRanges(train, space.ranges);
  } else if (TraitsOf(problem.law).has_placed_leg && !Fits(problem, ParameterId::kThetaTd)) {
    space.ranges.push_back({DesignSetting::kAngle, std::max(angle.low - kMostTurn, 0.0),
                            std::min(angle.high + kMostTurn, std::max(kSteepest, angle.high))});
  }
  space.ranges.push_back({DesignSetting::kHeight, 0.85 * height.low, 1.6 * height.high});
  if (!space.like.parameters.on_guide)
    space.ranges.push_back({DesignSetting::kSpeed, 0.0, std::max(1.5 * speed.high, kSlowest)});
  if (gain.high > 0.0 && !Fits(problem, ParameterId::kKp))
    space.ranges.push_back({DesignSetting::kGain, 0.0, 2.0 * gain.high});
  return space;
}

void SetRanges(DesignSpace& space, std::span<const DesignRange> ranges, const std::string& place) {
  for (const DesignRange& range : ranges) {
    const DesignSettingInfo& info = InfoOf(range.setting);
    const auto at = std::find_if(space.ranges.begin(), space.ranges.end(),
                                 [&](const DesignRange& r) { return r.setting == range.setting; });
    if (at == space.ranges.end())
      throw InputError({place, std::string(info.name), "cannot be set in these trials",
                        "The set-up lacks it, or its value is fitted."});
    const auto& [low, high] = kWidest[static_cast<std::size_t>(range.setting)];
    // Rounding of the unit.
    const double slack = 1e-9 * (high - low);
    if (!(range.low <= range.high) || range.low / info.si < low - slack ||
        range.high / info.si > high + slack)
      throw InputError({place,
                        std::string(info.name) + " = " + FormatDouble(range.low / info.si) + ":" +
                            FormatDouble(range.high / info.si),
                        RangeText(low, high, info), "The lower end comes first."});
    *at = range;
  }
}

TrialProblem TrialOf(const TrialDesign& design, const TrialProblem& like) {
  TrialProblem trial = like;
  trial.file = trial.recording = "the trial to record";  // what acts in one trial does not in it
  if (!std::isnan(design.touchdown_angle)) trial.parameters.theta_td = design.touchdown_angle;
  trial.parameters.m += design.added_mass;
  if (design.kp) trial.parameters.kp = *design.kp;
  trial.start_mode = Mode::kFlight;
  trial.touchdown_angles.clear();
  trial.inputs.clear();
  if (trial.parameters.robot && trial.parameters.robot->control == MotorControl::kRecorded) {
    RobotParameters<double>& robot = *trial.parameters.robot;
    robot.control = MotorControl::kHeld;
    for (int leg = 0; leg < robot.legs; ++leg)
      robot.angle[static_cast<std::size_t>(leg)] = AngleOf(like, leg);
  }
  trial.parameters.time_origin = trial.begin_s = 0.0;  // of a hop: it began within a trial
  trial.shared_priors.clear();
  const int states = like.parameters.robot ? 6 : 4;
  trial.own.resize(static_cast<std::size_t>(states));
  trial.start.conservativeResize(states);
  if (!std::isnan(design.pitch)) trial.start[4] = design.pitch;
  for (std::size_t leg = 0; leg < design.leg_angle.size(); ++leg)
    if (!std::isnan(design.leg_angle[leg]))
      trial.parameters.robot->angle[leg] = design.leg_angle[leg];
  trial.start.head<4>() << like.start[0], design.height, design.speed, design.throw_speed;
  for (int k = 0; k < trial.own_count(); ++k) trial.own[k].prior_mean = trial.start[k];
  trial.contact = {};
  return trial;
}

std::string Describe(const TrialDesign& design) {
  const auto text = [](const char* format, auto... values) {
    char line[160];
    std::snprintf(line, sizeof line, format, values...);
    return std::string(line);
  };
  const bool thrown = design.throw_speed != 0.0;
  std::string words = text("%s from %.3g m at %.3g m/s%s", thrown ? "throw" : "drop", design.height,
                           std::abs(design.speed), design.speed < 0.0 ? " backwards" : "");
  if (thrown) words += text(" and %.3g m/s up", design.throw_speed);
  if (!std::isnan(design.touchdown_angle))
    words += text(" with a touch-down angle of %.3g deg", design.touchdown_angle / kDegree);
  if (!std::isnan(design.pitch)) words += text(" with a pitch of %.3g deg", design.pitch / kDegree);
  std::string angles;
  for (const double angle : design.leg_angle)
    if (!std::isnan(angle)) angles += text(angles.empty() ? "%.3g" : ", %.3g", angle / kDegree);
  if (!angles.empty()) words += " and the motors held at " + angles + " deg";
  if (design.kp) words += text(" and a controller gain of %.3g N s", *design.kp);
  if (design.added_mass != 0.0) words += text(" and %.3g kg added", design.added_mass);
  return words;
}

}  // namespace hoplab
