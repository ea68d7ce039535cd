#pragma once

#include <optional>
#include <string>
#include <vector>

#include "datasets/mechanism_spec.h"

namespace hoplab {

/// One `key: value` of a block; `group` is the block below it stands in, empty for none.
struct YamlField {
  std::string group;
  std::string key;
  std::string value;
  bool operator==(const YamlField&) const = default;
};
using YamlFields = std::vector<YamlField>;

/// Appends `key: value` where there is a value.
void AddOptional(YamlFields* fields, const std::string& group, const std::string& key,
                 const std::optional<double>& value);

YamlFields MechanismFields(const MechanismSpec& m);
YamlFields ControllerFields(const ControllerSpec& controller);
YamlFields StateFields(const StateSpec& state);

/// What put over `base` gives `wanted`; null where `wanted` lacks a key of `base`.
YamlFields Difference(const YamlFields& base, const YamlFields& wanted);
/// The same with those of a block side by side.
YamlFields Grouped(const YamlFields& fields);
/// {a: 1, leg: {b: 2}}
std::string Flow(const YamlFields& fields);

}  // namespace hoplab
