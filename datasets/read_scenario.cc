#include "datasets/read_scenario.h"

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/scenario_run.h"
#include "datasets/scenario_tasks.h"
#include "datasets/text_file.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {
namespace {

using Kind = YamlNode::Kind;

// Maps whose keys have dots in them.
const std::vector<std::string> kDottedKeyMaps = {"search.over", "sweep.grid",
                                                 "sweep.latin_hypercube.ranges"};

void AppendLeaves(const YamlNode& node, const std::string& key, std::string& text) {
  for (const YamlEntry& entry : node.entries)
    AppendLeaves(entry.value, key.empty() ? entry.key : key + "." + entry.key, text);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    AppendLeaves(node.items[i], key + "." + std::to_string(i), text);
  if (node.kind == Kind::kScalar) text += key + "=" + node.text + "\n";
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

Scenario ScenarioDocument::ReadAt(const KeyedNumbers& values, const std::string& place) const {
  Scenario scenario = ReadRunAt(root_, values, place);
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
  std::string text;
  AppendLeaves(WithoutTasks(root_), "", text);
  return text;
}

Scenario ReadScenario(const std::filesystem::path& file,
                      const std::vector<std::string>& set_options) {
  ScenarioDocument document = ScenarioDocument::FromFile(file);
  for (const std::string& option : set_options) document.SetFromOption(option);
  return document.Read();
}

}  // namespace hoplab
