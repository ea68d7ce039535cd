#include "datasets/import/dataset_text.h"

#include <algorithm>
#include <map>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/blank_values.h"
#include "datasets/import/column_target.h"
#include "datasets/import/robot_text.h"
#include "datasets/read_spec.h"
#include "datasets/write_dataset.h"
#include "datasets/yaml_tree.h"

namespace hoplab {
namespace {

// The values a new dataset waits for, in the order of the file.
std::vector<WaitingValue> WaitingValues(const DatasetText& dataset) {
  std::vector<WaitingValue> values;
  for (const NeededValue& needed : NeededValues(dataset.type))
    values.push_back({"mechanism." + needed.key, needed.hint, "0.01", needed.optional});
  if (dataset.type == MechanismKind::kRobot) {
    AddRobotValues(dataset, &values);
  } else if (dataset.type != MechanismKind::kBall) {
    for (std::size_t i = 0; i < dataset.trials.size(); ++i)
      values.push_back(
          {"trials." + std::to_string(i) + ".touchdown_angle_deg", kTouchdownAngleHint, "1"});
  }
  return values;
}

class Writer {
 public:
  Writer(const DatasetText& dataset, Blanks blanks)
      : dataset_(dataset), blanks_(blanks), waiting_(WaitingValues(dataset)) {
    for (const auto& [key, value] : dataset.values) CheckValue(key, value);
  }

  std::string Write() {
    text_ = "format: hoplab-dataset/1\nname: " + QuotedYaml(dataset_.name) +
            "\nsource: {kind: recorded, note: " + QuotedYaml(dataset_.note) +
            "}\nmechanism:\n  type: " + NameOf(dataset_.type) + "\n";
    std::string block;
    for (const NeededValue& needed : NeededValues(dataset_.type)) {
      const std::size_t dot = needed.key.find('.');
      const bool nested = dot != std::string::npos;
      const std::string of = nested ? needed.key.substr(0, dot) : "";
      if (nested && of != block) text_ += "  " + of + ":\n";
      block = of;
      Line(nested ? "    " : "  ", "mechanism." + needed.key);
    }
    if (dataset_.legs > 0) text_ += "  legs:\n";
    for (int leg = 0; leg < dataset_.legs; ++leg)
      Line("    - ", "mechanism.legs." + std::to_string(leg) + ".hip_m");
    text_ += "channels:\n";
    for (const Channel channel : dataset_.channels)
      text_ += std::string("  ") + ChannelName(channel) +
               (IsContact(channel) ? ": {}\n" : ": {sigma: estimate}\n");
    WriteInputs();
    text_ += "trials:\n";
    for (std::size_t i = 0; i < dataset_.trials.size(); ++i) WriteTrial(i);
    return text_;
  }

 private:
  void WriteInputs() {
    if (const auto given = values_.find("controller"); given != values_.end())
      text_ += "controller: " + given->second + "\n";
    if (dataset_.inputs.empty()) return;
    if (values_.count("controller") == 0) text_ += "controller: {type: recorded}\n";
    text_ += "inputs:\n";
    for (const InputKind input : dataset_.inputs)
      text_ += std::string("  ") + InfoOf(input).key + ": {column: " + TargetName(input) + "}\n";
  }

  void WriteTrial(std::size_t i) {
    const DatasetText::Trial& trial = dataset_.trials[i];
    const std::string path = "trials." + std::to_string(i) + ".";
    text_ += "  - file: " + trial.file + "\n    role: " + RoleName(trial.role) + "\n";
    if (dataset_.type == MechanismKind::kRobot) {
      if (Waits(path + "controller") &&
          (values_.count("controller") == 0 || values_.count(path + "controller") != 0))
        Line("    ", path + "controller");
      if (Waits(path + "controller.angles_rad")) {
        text_ += "    controller:\n";
        Line("      ", path + "controller.angles_rad");
      }
      text_ += StartText(trial.robot, values_.count(path + "initial") != 0);
    }
    for (const char* key : {"touchdown_angle_deg", "initial"})
      if (Waits(path + key)) Line("    ", path + key);
  }

  const WaitingValue* Find(const std::string& key) const {
    const auto at = std::find_if(waiting_.begin(), waiting_.end(),
                                 [&](const WaitingValue& w) { return w.key == key; });
    return at == waiting_.end() ? nullptr : &*at;
  }
  bool Waits(const std::string& key) const { return Find(key) != nullptr; }

  void CheckValue(const std::string& key, const std::string& value) {
    const WaitingValue* waits = Find(key);
    if (waits == nullptr) {
      std::vector<std::string> known;
      for (const WaitingValue& w : waiting_) known.push_back(w.key);
      throw InputError({"--set", Printable(key), "is no value that a new dataset waits for",
                        DidYouMean(key, known)});
    }
    const std::string shown = Printable(key) + " = " + Printable(value);
    const char form = waits->sample.front();
    const bool is_number = form != '[' && form != '{';
    if (is_number && !ParseDouble(value))
      throw InputError({"--set", shown, "is not a number",
                        "Write a number with a decimal point, in the unit of the name."});
    if (!is_number && !IsOneOf(value, form))
      throw InputError({"--set", shown, form == '[' ? "is not a list" : "is not a block",
                        "Write it on one line, as " + waits->sample + "."});
    values_[key] = value;
  }

  // A list, or a block in braces, on one line.
  static bool IsOneOf(const std::string& value, char bracket) {
    const bool closed = value.size() > 1 && value.front() == bracket &&
                        value.back() == (bracket == '[' ? ']' : '}') &&
                        value.find_first_of("\r\n#") == std::string::npos;
    if (!closed) return false;
    const YamlNode node = ParseYamlValue(value, "--set");
    return node.kind == (bracket == '[' ? YamlNode::Kind::kSequence : YamlNode::Kind::kMap);
  }

  void Line(const std::string& indent, const std::string& path) {
    const WaitingValue& waits = *Find(path);
    const std::string key = path.substr(path.rfind('.') + 1);
    const auto given = values_.find(path);
    if (given != values_.end()) {
      text_ += indent + key + ": " + given->second + "\n";
    } else if (key == "gravity_m_per_s2") {
      text_ += indent + key + ": 9.81\n";
    } else if (waits.optional) {
      text_ += indent + "# " + key + ":  # " + waits.hint + "\n";
    } else {
      text_ += indent + key + ":" + (blanks_ == Blanks::kSamples ? " " + waits.sample : "") +
               "  # " + waits.hint + "\n";
    }
  }

  const DatasetText& dataset_;
  const Blanks blanks_;
  std::vector<WaitingValue> waiting_;
  std::map<std::string, std::string> values_;
  std::string text_;
};

}  // namespace

std::string FormatDatasetText(const DatasetText& dataset, Blanks blanks) {
  return Writer(dataset, blanks).Write();
}

}  // namespace hoplab
