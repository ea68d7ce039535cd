#include "app/records/comparison_values.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <set>

#include "base/nan.h"

namespace hoplab {
namespace {

constexpr double kLevel = 0.05;  // of all values of a run together
constexpr double kTwoSided95 = 1.959963984540054;

struct Interval {
  double value = kNaN, low = kNaN, high = kNaN;
  bool between_trials = false;
  double half() const { return 0.5 * (high - low); }
};

Interval IntervalOf(const ComparedSide& side, const std::string& name) {
  Interval out;
  const Json* p = side.parameter(name);
  if (!p) return out;
  out.value = NumberAt(*p, "/value");
  out.between_trials = side.misfit() && JsonAt(*p, "/ci95_between_trials").is_array();
  const std::string key = out.between_trials ? "/ci95_between_trials" : "/ci95";
  out.low = NumberAt(*p, key + "/0");
  out.high = NumberAt(*p, key + "/1");
  return out;
}

Json PairOrNull(double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high)) return nullptr;
  return Json::array({low, high});
}

// A value of one run beside that of the first.
Json ValueRecord(const Interval& first, const Interval& own, bool is_first, bool independent) {
  const double difference = is_first ? kNaN : own.value - first.value;
  const double half = independent ? std::hypot(first.half(), own.half()) : kNaN;
  const double z = half > 0.0 ? kTwoSided95 * difference / half : kNaN;
  double p_value = kNaN;
  if (std::isfinite(z)) {
    const boost::math::normal normal;
    p_value = 2.0 * boost::math::cdf(boost::math::complement(normal, std::abs(z)));
  }
  return {{"value", NumberOrNull(own.value)},
          {"ci95", PairOrNull(own.low, own.high)},
          {"between_trials", own.between_trials},
          {"difference", NumberOrNull(difference)},
          {"difference_ci95", PairOrNull(difference - half, difference + half)},
          {"z", NumberOrNull(z)},
          {"p_value", NumberOrNull(p_value)},
          {"clear", false}};
}

// Holm's steps: of all values of a run none is called clear by chance in 95 of 100 comparisons.
void MarkClear(Json& values, std::size_t run) {
  std::vector<Json*> tested;
  for (Json& value : values) {
    if (value["runs"][run]["p_value"].is_number()) tested.push_back(&value["runs"][run]);
  }
  std::sort(tested.begin(), tested.end(), [](const Json* a, const Json* b) {
    return (*a)["p_value"].get<double>() < (*b)["p_value"].get<double>();
  });
  for (std::size_t i = 0; i < tested.size(); ++i) {
    const auto left = static_cast<double>(tested.size() - i);
    if ((*tested[i])["p_value"].get<double>() * left > kLevel) return;
    (*tested[i])["clear"] = true;
  }
}

}  // namespace

Json ValuesRecord(const std::vector<ComparedSide>& sides, const std::vector<bool>& independent) {
  Json out = Json::array();
  std::set<std::string> seen;
  for (const ComparedSide& from : sides) {
    for (const Json& p : from.parameters()) {
      const std::string name = TextAt(p, "/name");
      if (!seen.insert(name).second) continue;
      const Interval first = IntervalOf(sides.front(), name);
      Json runs = Json::array();
      for (std::size_t i = 0; i < sides.size(); ++i)
        runs.push_back(ValueRecord(first, IntervalOf(sides[i], name), i == 0, independent[i]));
      out.push_back({{"name", name}, {"unit", TextAt(p, "/unit")}, {"runs", runs}});
    }
  }
  for (std::size_t i = 1; i < sides.size(); ++i) MarkClear(out, i);
  return out;
}

}  // namespace hoplab
