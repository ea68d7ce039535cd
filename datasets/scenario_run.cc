#include "datasets/scenario_run.h"

#include <utility>

#include "base/input_error.h"
#include "base/range.h"
#include "base/text.h"
#include "base/units.h"
#include "datasets/read_record.h"
#include "datasets/read_robot.h"
#include "datasets/read_spec.h"

namespace hoplab {
namespace {

using Kind = YamlNode::Kind;

constexpr const char* kScenarioFormat = "hoplab-scenario/1";
constexpr int kMaxHops = 1'000'000;
constexpr Range kStopTime = Positive(1e6, "s");

NamedNumber ReadNamedNumber(const std::string& name, const YamlCursor& cursor) {
  return {name, cursor.Number(kAnyNumber), {cursor.place()}};
}

// The folder a scenario's file lies in; empty for one that is no file.
std::filesystem::path FolderOf(const YamlCursor& root) {
  const std::string& place = root.place();
  return std::filesystem::path(place.substr(0, place.rfind(':'))).parent_path();
}

// A formula's file, beside the scenario's, or the formula itself.
EffectFile ReadFormula(const YamlCursor& file, const std::filesystem::path& folder) {
  if (file.node().kind == Kind::kMap) return ReadEffectBlock(file);
  return ReadEffectFile(folder / file.Name());
}

// The parameters of an effect of the file, `file` of a formula among them.
EffectSpec ReadEffect(const std::string& name, const YamlCursor& given,
                      const std::filesystem::path& folder) {
  EffectSpec effect;
  effect.name = name;
  effect.origin.place = given.place();
  // `torque_bending:` with nothing behind it has no parameters.
  if (given.node().kind == Kind::kNull) return effect;
  for (const auto& [key, value] : given.Entries(0)) {
    if (key != "file") {
      effect.parameters.push_back(ReadNamedNumber(key, value));
      continue;
    }
    effect.formula = ReadFormula(value, folder);
    if (effect.formula->source.name != name)
      value.Fail("is the file of " + effect.formula->source.name + ", and stands under " + name,
                 "Give the effect the name its file says.");
  }
  return effect;
}

// effects: {air_drag: {c_drag: 0.05}, umbilical: {file: umbilical.yaml, k: 2}}, or a list of files
// and names, each at its typical size.
std::vector<EffectSpec> ReadEffects(const YamlCursor& cursor, const std::filesystem::path& folder) {
  std::vector<EffectSpec> effects;
  if (cursor.node().kind != Kind::kSequence) {
    for (const auto& [name, given] : cursor.Entries(0))
      effects.push_back(ReadEffect(name, given, folder));
    return effects;
  }
  for (const YamlCursor& item : cursor.Items(1)) {
    EffectSpec effect;
    const bool block = item.node().kind == Kind::kMap;
    if (!block) effect.name = item.Name();
    effect.origin.place = item.place();
    effect.at_typical = true;
    if (block || IsEffectFile(effect.name)) {
      effect.formula = ReadFormula(item, folder);
      effect.name = effect.formula->source.name;
    }
    effects.push_back(std::move(effect));
  }
  return effects;
}

StopSpec ReadStop(const YamlCursor& cursor) {
  cursor.AllowOnly({"time_s", "hops"});
  StopSpec stop;
  stop.time_s = cursor.OptionalNumber("time_s", kStopTime);
  if (const auto hops = cursor.Optional("hops")) stop.hops = hops->Integer(1, kMaxHops);
  return stop;
}

// start_angle_deg: of the first touch-down of a leg that one other angle places.
std::optional<double> ReadStartAngle(const YamlCursor& owner, const Scenario& scenario) {
  const std::optional<YamlCursor> given = owner.Optional("start_angle_deg");
  if (!given) return std::nullopt;
  const MechanismKind type = scenario.mechanism.type;
  if (type == MechanismKind::kBall)
    given->Fail("is the angle of a leg, and a ball has none", "Remove it.");
  if (type == MechanismKind::kRobot)
    given->Fail("is the angle of a hopper's leg; a robot's follow its controller", "Remove it.");
  if (!scenario.touchdown_angles_rad.empty() || DrivesAngle(scenario.inputs))
    given->Fail("is told by touchdown_angle_deg or the log, which say every landing's",
                "Remove one of them.");
  return DegToRad(given->Number(TouchdownAngleRange(type)));
}

}  // namespace

std::vector<NamedNumber> ReadNamedNumbers(const YamlCursor& cursor, std::size_t min_size) {
  std::vector<NamedNumber> numbers;
  for (const auto& [name, value] : cursor.Entries(min_size))
    numbers.push_back(ReadNamedNumber(name, value));
  return numbers;
}

void ReadAngles(const YamlCursor& owner, MechanismKind type, double* angle,
                std::vector<double>* angles) {
  const std::optional<YamlCursor> given = owner.Optional("touchdown_angle_deg");
  angles->clear();
  if (!given || given->node().kind != Kind::kSequence || type == MechanismKind::kBall ||
      type == MechanismKind::kRobot) {
    *angle = ReadTouchdownAngle(owner, type);
    return;
  }
  for (const YamlCursor& item : given->Items(1))
    angles->push_back(DegToRad(item.Number(TouchdownAngleRange(type))));
  *angle = angles->front();
}

Scenario ReadRun(const YamlCursor& root) {
  Scenario scenario;
  scenario.name = root.Required("name", "a short name").Name();
  if (const auto law = root.Optional("law")) {
    scenario.law = law->Name();
    scenario.law_origin.place = law->place();
  }
  scenario.mechanism = ReadMechanism(root.Required("mechanism", "a block that begins with type"));
  if (const auto controller = root.Optional("controller"))
    scenario.controller = ReadController(*controller);
  if (const auto inputs = root.Optional("inputs"))
    scenario.inputs = ReadScenarioInputs(*inputs, FolderOf(root));
  if (!DrivesAngle(scenario.inputs))
    ReadAngles(root, scenario.mechanism.type, &scenario.touchdown_angle_rad,
               &scenario.touchdown_angles_rad);
  scenario.start_angle_rad = ReadStartAngle(root, scenario);
  if (const auto initial = root.Optional("initial")) {
    scenario.initial = ReadState(*initial);
    CheckStart(*initial, *scenario.initial, scenario.mechanism);
  }
  CheckDriven(root, scenario);
  if (const auto stop = root.Optional("stop")) scenario.stop = ReadStop(*stop);
  if (const auto effects = root.Optional("effects"))
    scenario.effects = ReadEffects(*effects, FolderOf(root));
  return scenario;
}

void CheckRoot(const YamlCursor& root) {
  if (root.node().kind == Kind::kNull)
    root.Fail("is empty; must begin with format: hoplab-scenario/1",
              "See datasets/README.md for an example.");
  CheckFormat(root, kScenarioFormat);
  root.AllowOnly({"format", "name", "law", "mechanism", "controller", "touchdown_angle_deg",
                  "start_angle_deg", "inputs", "initial", "stop", "effects", "search", "sweep",
                  "dataset"});
}

}  // namespace hoplab
