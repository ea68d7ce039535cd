#include "datasets/import/dataset_text.h"

#include <algorithm>
#include <map>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/blank_values.h"
#include "datasets/read_spec.h"
#include "datasets/write_dataset.h"

namespace hoplab {
namespace {

class Writer {
 public:
  Writer(const DatasetText& dataset, const std::string& blank) : dataset_(dataset), blank_(blank) {
    for (const auto& [key, value] : dataset.values) CheckValue(key, value);
  }

  std::string Write() {
    text_ = "format: hoplab-dataset/1\nname: " + QuotedYaml(dataset_.name) +
            "\nsource: {kind: recorded, note: " + QuotedYaml(dataset_.note) +
            "}\nmechanism:\n  type: " + NameOf(dataset_.type) + "\n";
    bool in_block = false;
    for (const NeededValue& needed : NeededValues(dataset_.type)) {
      const std::size_t dot = needed.key.find('.');
      const bool nested = dot != std::string::npos;
      if (nested && !in_block) text_ += "  " + needed.key.substr(0, dot) + ":\n";
      in_block = nested;
      Line(nested ? "    " : "  ", nested ? needed.key.substr(dot + 1) : needed.key,
           "mechanism." + needed.key, needed.hint);
    }
    text_ += "channels:\n";
    for (const Channel channel : dataset_.channels)
      text_ += std::string("  ") + ChannelName(channel) +
               (IsContact(channel) ? ": {}\n" : ": {sigma: estimate}\n");
    text_ += "trials:\n";
    for (std::size_t i = 0; i < dataset_.trials.size(); ++i) {
      text_ += "  - file: " + dataset_.trials[i].file +
               "\n    role: " + RoleName(dataset_.trials[i].role) + "\n";
      if (dataset_.type == MechanismKind::kBall) continue;
      Line("    ", "touchdown_angle_deg", "trials." + std::to_string(i) + ".touchdown_angle_deg",
           kTouchdownAngleHint);
    }
    return text_;
  }

 private:
  void CheckValue(const std::string& key, const std::string& value) {
    std::vector<std::string> known;
    for (const NeededValue& needed : NeededValues(dataset_.type))
      known.push_back("mechanism." + needed.key);
    if (dataset_.type != MechanismKind::kBall)
      for (std::size_t i = 0; i < dataset_.trials.size(); ++i)
        known.push_back("trials." + std::to_string(i) + ".touchdown_angle_deg");
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw InputError({"--set", Printable(key), "is no value that a new dataset waits for",
                        DidYouMean(key, known)});
    if (!ParseDouble(value))
      throw InputError({"--set", Printable(key) + " = " + Printable(value), "is not a number",
                        "Write a number with a decimal point, in the unit of the name."});
    values_[key] = value;
  }

  void Line(const std::string& indent, const std::string& key, const std::string& path,
            const std::string& hint) {
    const auto given = values_.find(path);
    if (given != values_.end()) {
      text_ += indent + key + ": " + given->second + "\n";
    } else if (key == "gravity_m_per_s2") {
      text_ += indent + key + ": 9.81\n";
    } else {
      text_ += indent + key + ":" + (blank_.empty() ? "" : " " + blank_) + "  # " + hint + "\n";
    }
  }

  const DatasetText& dataset_;
  const std::string& blank_;
  std::map<std::string, std::string> values_;
  std::string text_;
};

}  // namespace

std::string FormatDatasetText(const DatasetText& dataset, const std::string& blank) {
  return Writer(dataset, blank).Write();
}

}  // namespace hoplab
