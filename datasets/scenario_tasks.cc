#include "datasets/scenario_tasks.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/input_error.h"
#include "base/range.h"
#include "base/text.h"
#include "base/units.h"
#include "datasets/read_robot.h"
#include "datasets/read_spec.h"
#include "datasets/scenario_run.h"

namespace hoplab {
namespace {

using Kind = YamlNode::Kind;

constexpr int kMaxBudget = 1'000'000'000;
constexpr int kMaxSamples = 10'000'000;

// What ReadRunAt leaves out.
const std::vector<std::string> kTaskBlocks = {"search", "sweep", "dataset"};
// Text, in which a number would pass unseen.
const std::vector<std::string> kTextKeys = {"format", "name", "law"};

bool Contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
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
    KeyedNumbers values;
    for (const NamedNumber& number : row) values.emplace_back(number.name, number.value);
    probe.Try(values, item.place());
    rows.push_back(std::move(row));
  }
  return rows;
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
  CheckStart(item, *trial.initial, trial.mechanism);
  return trial;
}

}  // namespace

YamlNode WithoutTasks(YamlNode root) {
  for (const std::string& block : kTaskBlocks) root.Erase(block);
  return root;
}

Scenario ReadRunAt(const YamlNode& root, const KeyedNumbers& values, const std::string& place) {
  YamlNode copy = WithoutTasks(root);
  for (const auto& [key, value] : values) SetNumber(&copy, key, value, place);
  const YamlCursor cursor(copy, "");
  CheckRoot(cursor);
  return ReadRun(cursor);
}

void KeyProbe::Try(const KeyedNumbers& values, const std::string& place) const {
  ReadRunAt(root_, values, place);
}

SearchSpec ReadSearch(const YamlCursor& cursor, const KeyProbe& probe) {
  cursor.AllowOnly({"over", "objective", "constraints", "budget"});
  SearchSpec search;
  search.origin.place = cursor.place();
  search.over = ReadKeyRanges(
      cursor.Required("over", "what to vary, as {controller.kp_N_s: [0.5, 12]}"), probe);
  std::vector<std::string> objectives;
  for (const SearchObjective objective : kSearchObjectives)
    objectives.emplace_back(NameOf(objective));
  search.objective = kSearchObjectives[cursor
                                           .Required("objective",
                                                     "convergence_time, spectral_radius or "
                                                     "weighted; of a robot spectral_radius, "
                                                     "speed, cost_of_transport or peak_torque")
                                           .Choice(objectives)];
  if (const auto constraints = cursor.Optional("constraints"))
    search.constraints = ReadNamedNumbers(*constraints, 0);
  if (const auto budget = cursor.Optional("budget")) search.budget = budget->Integer(1, kMaxBudget);
  return search;
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

}  // namespace hoplab
