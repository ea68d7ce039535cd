#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "datasets/scenario.h"
#include "datasets/yaml_tree.h"

namespace hoplab {

/// A scenario file with values set over it by dotted key (`mechanism.leg.E_Pa`,
/// `effects.air_drag.c_drag`, `search.over.controller.kp_N_s`, `dataset.trials.0.role`). Parsed
/// once, read as often as wanted.
class ScenarioDocument {
 public:
  /// Throws InputError if the file is absent, too large or no YAML.
  static ScenarioDocument FromFile(const std::filesystem::path& file);
  /// The same for a text in memory; `place` is its name in messages.
  static ScenarioDocument FromText(std::string_view text, const std::string& place);

  /// Puts `value`, written as in the file, at `key`; `null` removes the key. Messages name the
  /// place as
  /// `--set key`. Throws InputError if the key leads nowhere or the value is no YAML; whether the
  /// key is known and the value in range is seen by Read.
  void Set(std::string_view key, std::string_view value);
  /// Splits `key=value` at the first `=` and sets it; throws InputError if there is none.
  void SetFromOption(std::string_view key_and_value);

  /// The whole scenario, checked. Throws InputError as ReadDataset does. Keys and values in
  /// `search.over` and `sweep` are tried out: each must name a number of the scenario and lie in
  /// its range.
  Scenario Read() const;
  /// The scenario with these numbers set, without its search, sweep and dataset blocks: one point
  /// of a sweep or search. Throws InputError with the place `place` if one does not fit.
  Scenario ReadAt(const std::vector<std::pair<std::string, double>>& values,
                  const std::string& place) const;
  /// The number that stands at a dotted key, unchecked; nothing where there is none.
  std::optional<double> NumberAt(std::string_view key) const;
  /// What the file says of a single run, search, sweep and dataset blocks left out, one
  /// `dotted.key=text` a line: equal for files that differ in layout and comments only.
  std::string ResolvedText() const;

 private:
  explicit ScenarioDocument(YamlNode root) : root_(std::move(root)) {}
  YamlNode root_;
};

/// Reads and checks a scenario with `--set key=value` options put over it, in order.
Scenario ReadScenario(const std::filesystem::path& file,
                      const std::vector<std::string>& set_options = {});

}  // namespace hoplab
