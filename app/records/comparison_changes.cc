#include <algorithm>

#include "app/records/comparison_values.h"

namespace hoplab {

Json ChangedRecord(const std::vector<ComparedSide>& sides) {
  Json out = Json::array();
  const auto add = [&](const std::string& what, const std::string& key, const auto& value_of) {
    Json values = Json::array();
    for (const ComparedSide& side : sides) values.push_back(value_of(side));
    const bool differs = std::any_of(values.begin(), values.end(),
                                     [&](const Json& v) { return v != values.front(); });
    if (differs) out.push_back({{"what", what}, {"key", key}, {"values", values}});
  };
  for (const char* key : {"dataset", "law", "law_variant", "version"})
    add("run", key,
        [&](const ComparedSide& s) { return JsonAt(s.record(), "/" + std::string(key)); });
  const auto keys_of = [&](const auto& part_of) {
    std::vector<std::string> keys;
    for (const ComparedSide& side : sides) {
      const Json& part = part_of(side);
      if (!part.is_object()) continue;
      for (const auto& [key, value] : part.items()) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
      }
    }
    return keys;
  };
  const auto entry = [](const Json& part, const std::string& key) {
    return part.is_object() && part.contains(key) ? part.at(key) : Json(nullptr);
  };
  const auto options = [](const ComparedSide& s) -> const Json& {
    return JsonAt(s.record(), "/options");
  };
  for (const std::string& key : keys_of(options)) {
    // What only one of two commands knows was not set.
    const bool common = std::all_of(sides.begin(), sides.end(), [&](const ComparedSide& s) {
      return options(s).contains(key);
    });
    if (!common) continue;
    const std::string told = key == "dataset" ? "dataset folder" : key;
    add("option", told, [&](const ComparedSide& s) { return entry(options(s), key); });
  }
  const auto stated = [](const ComparedSide& s) -> const Json& {
    return JsonAt(s.mechanism(), "/parameters");
  };
  for (const std::string& key : keys_of(stated)) {
    const bool fitted = std::any_of(sides.begin(), sides.end(), [&](const ComparedSide& s) {
      return s.parameter(key) != nullptr;
    });
    if (!fitted) add("stated", key, [&](const ComparedSide& s) { return entry(stated(s), key); });
  }
  return out;
}

}  // namespace hoplab
