#include "datasets/read_record.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <system_error>

#include "base/input_error.h"
#include "base/text.h"
#include "base/units.h"
#include "datasets/read_robot.h"
#include "datasets/read_spec.h"
#include "datasets/stance_torque.h"
#include "datasets/text_file.h"
#include "datasets/touchdowns.h"

namespace hoplab {
namespace {

constexpr const char* kAngleKey = "touchdown_angle_deg";
constexpr const char* kSigma = "touchdown_angle_sigma_deg";

using Kind = YamlNode::Kind;

void ReadAngleList(const YamlCursor& list, Trial& trial) {
  const Range range = TouchdownAngleRange(trial.mechanism.type);
  for (const YamlCursor& angle : list.Items(1))
    trial.touchdown_angles_rad.push_back(DegToRad(angle.Number(range)));
  trial.touchdown_angle_rad = trial.touchdown_angles_rad.front();
}

// Where a trial's angle stands, for messages.
InputError AngleError(const Trial& trial, const std::string& value, const std::string& rule,
                      const std::string& remedy) {
  return InputError({trial.origin.place, kAngleKey + value, rule, remedy});
}

double HeightAt(const Trial& trial, double angle_rad) {
  return TouchdownHeight(trial.mechanism, angle_rad);
}

// The angle at each touch-down that the trace shows, out of its own column.
void ReadFromLegAngle(Trial& trial, const std::string& trace_place) {
  const std::vector<double>* angle = trial.trace.Find(Channel::kLegAngle);
  if (angle == nullptr)
    throw AngleError(trial, " = {from: leg_angle}",
                     trace_place + " has no column leg_angle_rad to read it from",
                     "Add the column, or give the angles.");
  if (!TellsTouchdowns(trial.trace))
    throw AngleError(trial, " = {from: leg_angle}",
                     trace_place + " shows no touch-down: it has neither contact nor body_y_m",
                     "Add one of the two, or give the angles.");
  const std::vector<double> times = TouchdownTimes(
      trial.trace, [&](std::size_t, std::size_t row) { return HeightAt(trial, (*angle)[row]); });
  if (times.empty())
    throw AngleError(trial, " = {from: leg_angle}", trace_place + " shows no touch-down",
                     "Give the angle itself.");
  const Range range = TouchdownAngleRange(trial.mechanism.type);
  for (const double time : times) {
    const double value = ValueAt(trial.trace, *angle, time);
    const std::string at = " at " + FormatDouble(std::round(1e4 * time) / 1e4) + " s";
    if (std::isnan(value))
      throw InputError({trace_place, "leg_angle_rad" + at,
                        "has no sample on both sides of this touch-down",
                        "Give the angles themselves, as touchdown_angle_deg: [25, 24]."});
    if (!range.Contains(RadToDeg(value)))
      throw InputError({trace_place, "leg_angle_rad = " + FormatDouble(value) + at,
                        "the leg touches down there; must be in " + range.Text(),
                        "Check its unit and where it counts from: 0 is upright, ahead positive."});
    trial.touchdown_angles_rad.push_back(value);
  }
  trial.touchdown_angle_rad = trial.touchdown_angles_rad.front();
}

// An angle for each touch-down of the trace.
void CheckAngles(Trial& trial, const std::string& trace_place) {
  const std::size_t given = trial.touchdown_angles_rad.size();
  const bool each = given > 0 || trial.touchdown_angle_sigma_rad;
  if (!each) return;
  const auto height = [&](std::size_t touchdowns, std::size_t) {
    return HeightAt(trial, given == 0
                               ? trial.touchdown_angle_rad
                               : trial.touchdown_angles_rad[std::min(touchdowns, given - 1)]);
  };
  const std::size_t shown = TouchdownTimes(trial.trace, height).size();
  if (given > 0 && shown > given)
    throw AngleError(
        trial, " has " + std::to_string(given) + (given == 1 ? " angle" : " angles"),
        trace_place + " shows " + std::to_string(shown) + " touch-downs, and each needs its own",
        "Add what is missing, or end the record before.");
  // Each hop's angle is its own, about the one that is given for all.
  if (given == 0)
    trial.touchdown_angles_rad.assign(std::max<std::size_t>(shown, 1), trial.touchdown_angle_rad);
}

void CheckInputColumn(const InputSpec& input, const Trace& trace, const std::string& trace_place) {
  const std::string key = std::string("inputs.") + InfoOf(input.id).key;
  const std::vector<double>* values = trace.Find(input.column);
  if (values == nullptr) {
    std::vector<std::string> names;
    for (const TraceColumn& column : trace.columns) names.push_back(column.name);
    const std::optional<std::string> nearest = NearestWord(input.column, names);
    throw InputError(
        {input.origin.place, key, trace_place + " has no column " + Printable(input.column),
         nearest
             ? "Did you mean " + Printable(*nearest) + "? Say column: " + Printable(*nearest) + "."
             : "Add the column, or write " + std::string(InfoOf(input.id).key) +
                   ": null under `inputs` of the trial."});
  }
  const Range range = InfoOf(input.id).range;
  std::size_t samples = 0;
  for (std::size_t row = 0; row < values->size(); ++row) {
    const double value = (*values)[row];
    if (std::isnan(value)) continue;
    ++samples;
    if (!range.Contains(value))
      throw InputError({trace_place + ", row " + std::to_string(row + 1),
                        Printable(input.column) + " = " + FormatDouble(value),
                        "must be in " + range.Text() + " to drive " + InfoOf(input.id).key,
                        RangeRemedy(value, range)});
  }
  if (samples == 0)
    throw InputError({input.origin.place, key,
                      trace_place + " has no sample in the column " + Printable(input.column),
                      "Fill it in, or write " + std::string(InfoOf(input.id).key) +
                          ": null under `inputs` of the trial."});
}

void CheckClock(const Dataset& dataset, const std::string& clock, const std::string& place,
                const std::string& key) {
  if (clock.empty()) return;
  std::vector<std::string> names;
  for (const ClockSpec& c : dataset.clocks) names.push_back(c.name);
  if (std::find(names.begin(), names.end(), clock) != names.end()) return;
  throw InputError({place, key + ".clock = " + Printable(clock), "is no clock of this dataset",
                    names.empty() ? "Add it, as clocks: {" + Printable(clock) + ": {offset_s: 0}}."
                                  : DidYouMean(clock, names)});
}

}  // namespace

void ReadTouchdownAngles(const YamlCursor& item, Trial& trial) {
  const MechanismKind type = trial.mechanism.type;
  const std::optional<YamlCursor> angle = item.Optional(kAngleKey);
  const std::optional<YamlCursor> sigma = item.Optional(kSigma);
  if (FindInput(trial.inputs, InputKind::kLegAngle) != nullptr) {
    for (const std::optional<YamlCursor>& given : {angle, sigma})
      if (given)
        given->FailAtKey("the input leg_angle_rad says at which angle the leg touches down",
                         "Remove one of the two.");
    return;
  }
  const Kind kind = angle ? angle->node().kind : Kind::kScalar;
  const bool has_angle = type != MechanismKind::kBall && type != MechanismKind::kRobot;
  if (has_angle && kind == Kind::kSequence) {
    ReadAngleList(*angle, trial);
  } else if (has_angle && kind == Kind::kMap) {
    angle->AllowOnly({"from"});
    angle->Required("from", "leg_angle").Choice({"leg_angle"});
    trial.touchdown_from_leg_angle = true;
  } else {
    trial.touchdown_angle_rad = ReadTouchdownAngle(item, type);
  }
  if (!sigma) return;
  if (!has_angle)
    sigma->FailAtKey(std::string("a ") + NameOf(type) +
                         " has no leg that could touch down at an angle of its own",
                     "Remove it.");
  trial.touchdown_angle_sigma_rad = DegToRad(sigma->Number(Positive(90, "deg")));
}

std::vector<ScenarioInput> ReadScenarioInputs(const YamlCursor& cursor,
                                              const std::filesystem::path& folder) {
  std::vector<ScenarioInput> inputs;
  for (const auto& [name, block] : cursor.Entries(0)) {
    YamlNode rest = block.node();
    for (const char* own : {"file", "sigma"}) rest.Erase(own);
    YamlNode one;
    one.kind = Kind::kMap;
    one.place = block.place();
    one.entries.push_back({name, block.place(), rest});
    ScenarioInput input;
    input.spec = ReadInputs(YamlCursor(one, cursor.key_path())).front();
    if (!input.spec.clock.empty())
      block.Required("clock", "").Fail("a scenario has no clocks", "Say delay_s.");
    const Range sigma{0, 1e6, false, false, InfoOf(input.spec.id).range.unit};
    input.sigma = block.OptionalNumber("sigma", sigma).value_or(0);
    const YamlCursor file = block.Required("file", "the CSV file with its samples");
    const std::filesystem::path path = folder / file.Name();
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
      file.Fail("there is no such file beside the scenario", "Check the path.");
    constexpr std::uint64_t kMostBytes = 64ull << 20;
    const Trace trace = ParseTraceCsv(ReadFileBytes(path, kMostBytes), path.string());
    CheckInputColumn(input.spec, trace, path.string());
    const std::vector<double>& values = *trace.Find(input.spec.column);
    for (std::size_t row = 0; row < values.size(); ++row) {
      if (std::isnan(values[row])) continue;
      input.time_s.push_back(trace.time_s[row]);
      input.values.push_back(values[row]);
    }
    if (input.spec.of_stance) input.values = HeldThroughFlights(input.values, {});
    inputs.push_back(std::move(input));
  }
  return inputs;
}

bool DrivesAngle(const std::vector<ScenarioInput>& inputs) {
  return std::any_of(inputs.begin(), inputs.end(), [](const ScenarioInput& input) {
    return input.spec.id == InputKind::kLegAngle;
  });
}

void CheckDriven(const YamlCursor& root, const Scenario& scenario) {
  Trial trial;
  trial.mechanism = scenario.mechanism;
  trial.controller = scenario.controller;
  trial.initial = scenario.initial;
  for (const ScenarioInput& input : scenario.inputs) trial.inputs.push_back(input.spec);
  CheckDriven(root, trial);
}

void CheckDriven(const YamlCursor& item, const Trial& trial) {
  CheckMotors(item, trial.mechanism, trial.controller, trial.initial);
  const std::string path = item.key_path().empty() ? "" : item.key_path() + ".";
  const auto fail = [&](const InputSpec& input, const std::string& rule,
                        const std::string& remedy) {
    throw InputError({input.origin.place, path + "inputs." + InfoOf(input.id).key, rule, remedy});
  };
  if (trial.mechanism.type == MechanismKind::kRobot)
    return CheckRobotInputs(item.place(), path, trial.mechanism, trial.controller, trial.inputs);
  for (const InputSpec& input : trial.inputs) {
    if (MotorOf(input.id) >= 0)
      fail(input,
           std::string("drives a motor of a robot, and this mechanism is a ") +
               NameOf(trial.mechanism.type),
           std::string("Write ") + InfoOf(FamilyOf(input.id)).key + ".");
    const bool of_leg = input.id == InputKind::kHipTorque || input.id == InputKind::kLegAngle;
    if (of_leg && trial.mechanism.type == MechanismKind::kBall)
      fail(input, "a ball has no leg to drive", "Remove it.");
    if (trial.mechanism.toe_mass_kg.value_or(0) > 0)
      fail(input, "a leg with a toe mass is moved by its placement, not by a log",
           "Remove toe_mass_kg or this input.");
    if (input.id == InputKind::kHipTorque && trial.controller)
      fail(input, "the hip torque comes from the log, and a controller is given too",
           "Remove one of the two; `controller: null` in a trial takes it away there.");
  }
}

void CompleteWithTrace(Trial& trial, const std::string& trace_place) {
  for (const InputSpec& input : trial.inputs) CheckInputColumn(input, trial.trace, trace_place);
  if (trial.touchdown_from_leg_angle) ReadFromLegAngle(trial, trace_place);
  CheckAngles(trial, trace_place);
}

void CheckRoles(const Dataset& dataset) {
  for (const ChannelSpec& channel : dataset.channels)
    CheckClock(dataset, channel.clock, channel.origin.place,
               std::string("channels.") + ChannelName(channel.id));
  for (const Trial& trial : dataset.trials) {
    for (const InputSpec& input : trial.inputs) {
      const std::string key = std::string("inputs.") + InfoOf(input.id).key;
      CheckClock(dataset, input.clock, input.origin.place, key);
      const bool measured = std::any_of(
          dataset.channels.begin(), dataset.channels.end(),
          [&](const ChannelSpec& channel) { return input.column == ChannelName(channel.id); });
      if (measured)
        throw InputError({input.origin.place, key,
                          "the column " + Printable(input.column) +
                              " is a channel too: it either drives the simulation or is compared "
                              "with it",
                          "Remove it from `channels`, or name another column, as column: "
                          "commanded."});
    }
  }
}

}  // namespace hoplab
