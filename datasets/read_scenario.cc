#include "datasets/read_scenario.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/input_error.h"
#include "base/text.h"
#include "base/units.h"
#include "datasets/read_record.h"
#include "datasets/read_robot.h"
#include "datasets/read_spec.h"
#include "datasets/text_file.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {
namespace {

using Kind = YamlNode::Kind;
using Numbers = std::vector<std::pair<std::string, double>>;

constexpr const char* kFormat = "hoplab-scenario/1";
constexpr int kMaxHops = 1'000'000;
constexpr int kMaxBudget = 1'000'000'000;
constexpr int kMaxSamples = 10'000'000;
constexpr Range kAnyNumber = {};
constexpr Range kStopTime = Positive(1e6, "s");

// Maps whose keys have dots in them.
const std::vector<std::string> kDottedKeyMaps = {"search.over", "sweep.grid",
                                                 "sweep.latin_hypercube.ranges"};
// What ScenarioDocument::ReadAt leaves out.
const std::vector<std::string> kTaskBlocks = {"search", "sweep", "dataset"};
// Text, in which a number would pass unseen.
const std::vector<std::string> kTextKeys = {"format", "name", "law"};

bool Contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

NamedNumber ReadNamedNumber(const std::string& name, const YamlCursor& cursor) {
  return {name, cursor.Number(kAnyNumber), {cursor.place()}};
}

std::vector<NamedNumber> ReadNamedNumbers(const YamlCursor& cursor, std::size_t min_size) {
  std::vector<NamedNumber> numbers;
  for (const auto& [name, value] : cursor.Entries(min_size))
    numbers.push_back(ReadNamedNumber(name, value));
  return numbers;
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

// touchdown_angle_deg: an angle, or a list of them.
void ReadAngles(const YamlCursor& owner, MechanismType type, double* angle,
                std::vector<double>* angles) {
  const std::optional<YamlCursor> given = owner.Optional("touchdown_angle_deg");
  angles->clear();
  if (!given || given->node().kind != Kind::kSequence || type == MechanismType::kBall ||
      type == MechanismType::kRobot) {
    *angle = ReadTouchdownAngle(owner, type);
    return;
  }
  for (const YamlCursor& item : given->Items(1))
    angles->push_back(DegToRad(item.Number(TouchdownAngleRange(type))));
  *angle = angles->front();
}

// start_angle_deg: of the first touch-down of a leg that one other angle places.
std::optional<double> ReadStartAngle(const YamlCursor& owner, const Scenario& scenario) {
  const std::optional<YamlCursor> given = owner.Optional("start_angle_deg");
  if (!given) return std::nullopt;
  const MechanismType type = scenario.mechanism.type;
  if (type == MechanismType::kBall)
    given->Fail("is the angle of a leg, and a ball has none", "Remove it.");
  if (type == MechanismType::kRobot)
    given->Fail("is the angle of a hopper's leg; a robot's follow its controller", "Remove it.");
  if (!scenario.touchdown_angles_rad.empty() || DrivesAngle(scenario.inputs))
    given->Fail("is told by touchdown_angle_deg or the log, which say every landing's",
                "Remove one of them.");
  return DegToRad(given->Number(TouchdownAngleRange(type)));
}

// Mechanism, controller, start and effects: all that a single run needs.
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
    CheckStart(*initial, *scenario.initial, scenario.mechanism.type);
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
  CheckFormat(root, kFormat);
  root.AllowOnly({"format", "name", "law", "mechanism", "controller", "touchdown_angle_deg",
                  "start_angle_deg", "inputs", "initial", "stop", "effects", "search", "sweep",
                  "dataset"});
}

void SetNumber(YamlNode* root, const std::string& key, double value, const std::string& place) {
  YamlNode node;
  node.kind = Kind::kScalar;
  node.text = FormatDouble(value);
  node.place = place;
  const std::string block = key.substr(0, key.find('.'));
  if (Contains(kTaskBlocks, block) || Contains(kTextKeys, block))
    throw InputError(
        {place, Printable(key),
         "must be a number of the mechanism, the controller, the start, the stop or an "
         "effect",
         "Give a key such as mechanism.leg.E_Pa."});
  SetYaml(*root, key, std::move(node));
}

void AppendLeaves(const YamlNode& node, const std::string& key, std::string& text) {
  for (const YamlEntry& entry : node.entries)
    AppendLeaves(entry.value, key.empty() ? entry.key : key + "." + entry.key, text);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    AppendLeaves(node.items[i], key + "." + std::to_string(i), text);
  if (node.kind == Kind::kScalar) text += key + "=" + node.text + "\n";
}

// Tries values at the keys that a search or sweep varies.
class KeyProbe {
 public:
  explicit KeyProbe(const YamlNode& root) : root_(root) {
    for (const std::string& block : kTaskBlocks) root_.Erase(block);
  }
  // Throws unless each value may stand at its key, all of them together.
  void Try(const Numbers& values, const std::string& place) const {
    YamlNode copy = root_;
    for (const auto& [key, value] : values) SetNumber(&copy, key, value, place);
    const YamlCursor cursor(copy, "");
    CheckRoot(cursor);
    ReadRun(cursor);
  }

 private:
  YamlNode root_;
};

KeyRange ReadKeyRange(const std::string& key, const YamlCursor& cursor, const KeyProbe& probe) {
  const std::vector<YamlCursor> ends = cursor.Items(2);
  if (ends.size() != 2) cursor.Fail("must be two numbers, [low, high]", "Remove the others.");
  const KeyRange range = {
      key, ends[0].Number(kAnyNumber), ends[1].Number(kAnyNumber), {cursor.place()}};
  if (range.low >= range.high)
    ends[1].Fail("must be greater than the low end, " + FormatDouble(range.low),
                 "Swap the two or widen the range.");
  probe.Try({{key, range.low}}, range.origin.place);
  probe.Try({{key, range.high}}, range.origin.place);
  return range;
}

std::vector<KeyRange> ReadKeyRanges(const YamlCursor& cursor, const KeyProbe& probe) {
  std::vector<KeyRange> ranges;
  for (const auto& [key, value] : cursor.Entries(1))
    ranges.push_back(ReadKeyRange(key, value, probe));
  return ranges;
}

SearchSpec ReadSearch(const YamlCursor& cursor, const KeyProbe& probe) {
  cursor.AllowOnly({"over", "objective", "constraints", "budget"});
  SearchSpec search;
  search.origin.place = cursor.place();
  search.over = ReadKeyRanges(
      cursor.Required("over", "what to vary, as {controller.kp_N_s: [0.5, 12]}"), probe);
  search.objective = static_cast<ObjectiveKind>(
      cursor
          .Required("objective",
                    "convergence_time, spectral_radius or weighted; of a robot spectral_radius, "
                    "speed, cost_of_transport or peak_torque")
          .Choice({"convergence_time", "spectral_radius", "weighted", "speed", "cost_of_transport",
                   "peak_torque"}));
  if (const auto constraints = cursor.Optional("constraints"))
    search.constraints = ReadNamedNumbers(*constraints, 0);
  if (const auto budget = cursor.Optional("budget")) search.budget = budget->Integer(1, kMaxBudget);
  return search;
}

std::vector<SweepAxis> ReadGrid(const YamlCursor& cursor, const KeyProbe& probe) {
  std::vector<SweepAxis> axes;
  for (const auto& [key, list] : cursor.Entries(1)) {
    SweepAxis axis;
    axis.key = key;
    axis.origin.place = list.place();
    for (const YamlCursor& item : list.Items(1)) {
      axis.values.push_back(item.Number(kAnyNumber));
      probe.Try({{key, axis.values.back()}}, item.place());
    }
    axes.push_back(std::move(axis));
  }
  return axes;
}

std::vector<std::vector<NamedNumber>> ReadList(const YamlCursor& cursor, const KeyProbe& probe) {
  std::vector<std::vector<NamedNumber>> rows;
  for (const YamlCursor& item : cursor.Items(1)) {
    std::vector<NamedNumber> row = ReadNamedNumbers(item, 1);
    const auto key_of = [](const NamedNumber& number) { return number.name; };
    const auto same_key = [&](const NamedNumber& a, const NamedNumber& b) {
      return key_of(a) == key_of(b);
    };
    if (!rows.empty() &&
        !std::equal(row.begin(), row.end(), rows[0].begin(), rows[0].end(), same_key))
      item.Fail("must have the keys of the first row in the same order", "Add what is missing.");
    Numbers values;
    for (const NamedNumber& number : row) values.emplace_back(number.name, number.value);
    probe.Try(values, item.place());
    rows.push_back(std::move(row));
  }
  return rows;
}

SweepSpec ReadSweep(const YamlCursor& cursor, const KeyProbe& probe) {
  cursor.AllowOnly({"grid", "list", "latin_hypercube", "outputs"});
  SweepSpec sweep;
  sweep.origin.place = cursor.place();
  const auto grid = cursor.Optional("grid");
  const auto list = cursor.Optional("list");
  const auto hypercube = cursor.Optional("latin_hypercube");
  if (int{grid.has_value()} + int{list.has_value()} + int{hypercube.has_value()} != 1)
    cursor.FailAtKey("must have exactly one of grid, list and latin_hypercube",
                     "Remove or add one of them.");
  if (grid) {
    sweep.kind = SweepKind::kGrid;
    sweep.grid = ReadGrid(*grid, probe);
  } else if (list) {
    sweep.kind = SweepKind::kList;
    sweep.list = ReadList(*list, probe);
  } else {
    sweep.kind = SweepKind::kLatinHypercube;
    hypercube->AllowOnly({"samples", "ranges"});
    sweep.samples = hypercube->Required("samples", "how many points").Integer(1, kMaxSamples);
    sweep.ranges = ReadKeyRanges(
        hypercube->Required("ranges", "what to vary, as {initial.y_m: [0.2, 0.3]}"), probe);
  }
  std::set<std::string> names;
  for (const YamlCursor& output : cursor.Required("outputs", "a list of result names").Items(1)) {
    const std::string name = output.Name();
    if (!names.insert(name).second)
      output.Fail("stands twice in the list", "Remove one of the two.");
    sweep.outputs.push_back({name, {output.place()}});
  }
  return sweep;
}

GenerateTrial ReadGenerateTrial(const YamlCursor& item, const YamlNode& root,
                                const Scenario& scenario, std::size_t number) {
  item.AllowOnly({"role", "touchdown_angle_deg", "initial", "controller", "mechanism"});
  GenerateTrial trial;
  if (const auto role = item.Optional("role")) trial.role = ReadRole(*role);
  trial.file = std::string(RoleName(trial.role)) + "-" + std::to_string(number) + ".csv";
  trial.mechanism = ReadTrialMechanism(item, *root.Find("mechanism"), scenario.mechanism);
  trial.touchdown_angle_rad = scenario.touchdown_angle_rad;
  trial.touchdown_angles_rad = scenario.touchdown_angles_rad;
  if (item.Optional("touchdown_angle_deg"))
    ReadAngles(item, trial.mechanism.type, &trial.touchdown_angle_rad, &trial.touchdown_angles_rad);
  trial.controller = ReadOver(item, "controller", root.Find("controller"), ReadController);
  trial.initial = ReadOver(item, "initial", root.Find("initial"), ReadState);
  CheckMotors(item, trial.mechanism, trial.controller, trial.initial);
  if (!trial.initial)
    item.Fail("must have an initial state, here or in the scenario", "Add initial: {x_m: 0, ...}.");
  return trial;
}

GenerateSpec ReadGenerate(const YamlCursor& cursor, const YamlNode& root,
                          const Scenario& scenario) {
  cursor.AllowOnly({"name", "title", "sample_rate_hz", "channels", "initial_sigma",
                    "touchdown_angle_sigma_deg", "trials"});
  GenerateSpec generate;
  if (const auto name = cursor.Optional("name")) generate.name = name->Name();
  if (const auto title = cursor.Optional("title")) generate.title = title->Text();
  generate.sample_rate_hz = cursor.OptionalNumber("sample_rate_hz", Positive(1e6, "Hz"));
  if (const auto channels = cursor.Optional("channels")) {
    generate.channels = ReadChannels(*channels);
    for (const auto& [name, block] : channels->Entries(1)) {
      const auto sigma = block.Optional("sigma");
      if (sigma && !ParseDouble(sigma->node().text))
        sigma->Fail("must be a number: there is nothing to estimate it from yet",
                    "Write the noise to add, 1 standard deviation.");
    }
  }
  if (const auto sigma = cursor.Optional("initial_sigma"))
    generate.initial_sigma = ReadStateSigma(*sigma);
  if (const auto sigma = cursor.OptionalNumber("touchdown_angle_sigma_deg", Positive(90, "deg")))
    generate.touchdown_angle_sigma_rad = DegToRad(*sigma);
  for (const YamlCursor& item :
       cursor.Required("trials", "a list, as [{role: train, touchdown_angle_deg: 25}]").Items(1))
    generate.trials.push_back(ReadGenerateTrial(item, root, scenario, generate.trials.size() + 1));
  const bool has_train =
      std::any_of(generate.trials.begin(), generate.trials.end(),
                  [](const GenerateTrial& t) { return t.role == TrialRole::kTrain; });
  if (!has_train)
    cursor.Required("trials", "")
        .Fail("at least one trial must have role: train", "Change the role of the trials to fit.");
  return generate;
}

}  // namespace

ScenarioDocument ScenarioDocument::FromFile(const std::filesystem::path& file) {
  const YamlLimits limits;
  return ScenarioDocument(
      ParseYaml(ReadFileBytes(file, limits.max_bytes, kSamplesElsewhere), file.string(), limits));
}

ScenarioDocument ScenarioDocument::FromText(std::string_view text, const std::string& place) {
  return ScenarioDocument(ParseYaml(text, place));
}

void ScenarioDocument::Set(std::string_view key, std::string_view value) {
  const std::string place = "--set " + Printable(key, 200);
  SetYaml(root_, key, ParseYamlValue(value, place), kDottedKeyMaps);
}

void ScenarioDocument::SetFromOption(std::string_view key_and_value) {
  const std::size_t equals = key_and_value.find('=');
  if (equals == key_and_value.npos)
    throw InputError({"--set", Printable(key_and_value), "must be key=value",
                      "For example --set mechanism.leg.E_Pa=21e9."});
  Set(Trim(key_and_value.substr(0, equals)), key_and_value.substr(equals + 1));
}

Scenario ScenarioDocument::Read() const {
  const YamlCursor root(root_, "");
  CheckRoot(root);
  Scenario scenario = ReadRun(root);
  const std::string& place = root_.place;
  scenario.origin.place = place.substr(0, place.rfind(':'));
  const KeyProbe probe(root_);
  if (const auto search = root.Optional("search")) scenario.search = ReadSearch(*search, probe);
  if (const auto sweep = root.Optional("sweep")) scenario.sweep = ReadSweep(*sweep, probe);
  if (const auto dataset = root.Optional("dataset"))
    scenario.dataset = ReadGenerate(*dataset, root_, scenario);
  return scenario;
}

Scenario ScenarioDocument::ReadAt(const Numbers& values, const std::string& place) const {
  YamlNode copy = root_;
  for (const std::string& block : kTaskBlocks) copy.Erase(block);
  for (const auto& [key, value] : values) SetNumber(&copy, key, value, place);
  const YamlCursor root(copy, "");
  CheckRoot(root);
  Scenario scenario = ReadRun(root);
  scenario.origin.place = root_.place.substr(0, root_.place.rfind(':'));
  return scenario;
}

std::optional<double> ScenarioDocument::NumberAt(std::string_view key) const {
  const YamlNode* node = &root_;
  while (node && !key.empty()) {
    const std::size_t dot = key.find('.');
    node = node->At(key.substr(0, dot));
    key = dot == key.npos ? std::string_view() : key.substr(dot + 1);
  }
  if (!node || node->kind != Kind::kScalar) return std::nullopt;
  return ParseDouble(node->text);
}

std::string ScenarioDocument::ResolvedText() const {
  YamlNode copy = root_;
  for (const std::string& block : kTaskBlocks) copy.Erase(block);
  std::string text;
  AppendLeaves(copy, "", text);
  return text;
}

Scenario ReadScenario(const std::filesystem::path& file,
                      const std::vector<std::string>& set_options) {
  ScenarioDocument document = ScenarioDocument::FromFile(file);
  for (const std::string& option : set_options) document.SetFromOption(option);
  return document.Read();
}

}  // namespace hoplab
