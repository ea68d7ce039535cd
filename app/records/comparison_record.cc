#include "app/records/comparison_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "app/records/compared_side.h"
#include "app/records/csv.h"
#include "app/terminal/quantity.h"
#include "base/text.h"

namespace hoplab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLevel = 0.05;  // of all values of a run together
constexpr double kTwoSided95 = 1.959963984540054;

// Whether two runs are of the same recordings: then their errors are common.
bool SameRecordings(const ComparedSide& a, const ComparedSide& b) {
  if (TextAt(a.record(), "/dataset") != TextAt(b.record(), "/dataset") ||
      TextAt(a.record(), "/options/dataset") != TextAt(b.record(), "/options/dataset"))
    return false;
  const auto recordings = [](const ComparedSide& side) {
    std::set<std::string> files;
    for (const Json& trial : side.trials()) {
      const std::string file = TextAt(trial, "/file");
      files.insert(file.substr(0, file.find(".csv")));  // of a hop, its recording
    }
    return files;
  };
  const std::set<std::string> first = recordings(a), second = recordings(b);
  return first.empty() || second.empty() || first == second;
}

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

std::string UnitOfChannel(const std::string& channel) {
  const std::string bare = WithoutUnit(channel);
  if (bare == channel) return "";
  const std::string suffix = channel.substr(bare.size() + 1);
  if (suffix == "m_per_s") return "m/s";
  return suffix == "N_m" ? "N m" : suffix;
}

Json ErrorsRecord(const std::vector<ComparedSide>& sides) {
  Json out = Json::array();
  const auto add = [&](const std::string& what, const std::string& channel, const std::string& unit,
                       const auto& value_of) {
    Json values = Json::array();
    bool any = false;
    for (const ComparedSide& side : sides) {
      const double value = value_of(side);
      any = any || std::isfinite(value);
      values.push_back(NumberOrNull(value));
    }
    if (any)
      out.push_back({{"what", what},
                     {"channel", channel.empty() ? Json(nullptr) : Json(channel)},
                     {"unit", unit},
                     {"values", values}});
  };
  std::vector<std::string> channels;
  for (const ComparedSide& side : sides) {
    for (const auto& [name, value] : JsonAt(side.test(), "/rmse").items()) {
      if (std::find(channels.begin(), channels.end(), name) == channels.end())
        channels.push_back(name);
    }
  }
  for (const std::string& c : channels) {
    add("test error", c, UnitOfChannel(c),
        [&](const ComparedSide& s) { return NumberAt(s.test(), "/rmse/" + c); });
  }
  for (const std::string& c : channels) {
    add("train error", c, UnitOfChannel(c),
        [&](const ComparedSide& s) { return NumberAt(s.train(), "/rmse/" + c); });
  }
  add("test nll", "", "nats a sample",
      [](const ComparedSide& s) { return NumberAt(s.test(), "/nll_per_sample"); });
  add("chi2 per sample", "", "", [](const ComparedSide& s) { return s.chi2(); });
  return out;
}

Json CausesRecord(const std::vector<ComparedSide>& sides) {
  Json out = Json::array();
  std::vector<std::string> names;
  for (const ComparedSide& side : sides) {
    for (const Json& cause : JsonAt(side.record(), "/causes")) {
      const std::string name = TextAt(cause, "/name");
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  for (const std::string& name : names) {
    Json runs = Json::array();
    for (const ComparedSide& side : sides) {
      Json found = {{"looked_for", side.is_diagnosis()}, {"found", false}};
      for (const Json& cause : JsonAt(side.record(), "/causes")) {
        if (TextAt(cause, "/name") != name) continue;
        found["found"] = true;
        for (const char* key : {"probability", "share", "parameters"})
          found[key] = JsonAt(cause, std::string("/") + key);
      }
      runs.push_back(found);
    }
    out.push_back({{"name", name}, {"runs", runs}});
  }
  return out;
}

// What was set otherwise: law, options, and stated values that no run fitted.
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

Json RunsRecord(const std::vector<ComparedRun>& compared, const std::vector<ComparedSide>& sides,
                const std::vector<bool>& independent) {
  Json out = Json::array();
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Json& r = sides[i].record();
    out.push_back({{"name", sides[i].name()},
                   {"folder", compared[i].folder.string()},
                   {"command", JsonAt(r, "/command")},
                   {"dataset", JsonAt(r, "/dataset")},
                   {"law", JsonAt(r, "/law")},
                   {"status", JsonAt(r, "/status")},
                   {"verdict", JsonAt(r, "/verdict")},
                   {"sentence", JsonAt(r, "/sentence")},
                   {"probability_unlisted", JsonAt(r, "/probability_unlisted")},
                   {"other_recordings_than_first", i > 0 && independent[i]}});
  }
  return out;
}

// "d fell from 2.44 to 1.19 N s/m (z = -12)".
std::string ChangeText(const Json& value, const Json& own) {
  const double before = NumberAt(value, "/runs/0/value"), after = NumberAt(own, "/value");
  const std::string unit = TextAt(value, "/unit");
  const ReadableUnit readable = ReadableUnitOf(before != 0.0 ? before : after, unit);
  return fmt::format("{} {} from {} to {}{}{} (z = {})", TextAt(value, "/name"),
                     after > before ? "rose" : "fell", Significant(before * readable.factor, 4),
                     Significant(after * readable.factor, 4), readable.unit.empty() ? "" : " ",
                     readable.unit, Significant(NumberAt(own, "/z"), 2));
}

std::string Sentence(const Json& record) {
  const std::size_t last = record["runs"].size() - 1;
  const std::string from = TextAt(record, "/runs/0/name");
  const std::string to = TextAt(record["runs"][last], "/name");
  std::vector<std::string> changes;
  int tested = 0;
  for (const Json& value : record["values"]) {
    const Json& own = value["runs"][last];
    if (own["z"].is_number()) ++tested;
    if (own["clear"] == Json(true)) changes.push_back(ChangeText(value, own));
  }
  std::string text = "From " + from + " to " + to + ": ";
  if (record["runs"][last]["other_recordings_than_first"] != Json(true))
    text += "the same recordings, so the differences have no intervals of their own";
  else if (tested == 0)
    text += "no value has an interval in both runs";
  else if (changes.empty())
    text += "no value changed by more than its interval";
  else
    text += Join(changes, "; ") +
            (static_cast<std::size_t>(tested) > changes.size() ? "; the others agree" : "");
  for (const Json& error : record["errors"]) {
    const double before = NumberAt(error, "/values/0");
    const double after = NumberAt(error, "/values/" + std::to_string(last));
    if (TextAt(error, "/what") != "test error" || std::isnan(before) || std::isnan(after)) continue;
    const std::string unit = TextAt(error, "/unit");
    text += fmt::format("; test error of {} {} (was {})", WithoutUnit(TextAt(error, "/channel")),
                        ErrorText(after, unit), ErrorText(before, unit));
  }
  return text + ".";
}

}  // namespace

Json ComparisonRecord(const std::vector<ComparedRun>& runs) {
  std::vector<ComparedSide> sides;
  for (const ComparedRun& run : runs) sides.emplace_back(run);
  std::vector<bool> independent;
  for (const ComparedSide& side : sides)
    independent.push_back(!SameRecordings(sides.front(), side));
  RecordHeader header;
  header.command = "report";
  Json folders = Json::array();
  for (const ComparedRun& run : runs) folders.push_back(run.folder.string());
  header.options = {{"runs", folders}};
  Json record = NewRecord(header);
  record["runs"] = RunsRecord(runs, sides, independent);
  record["values"] = ValuesRecord(sides, independent);
  record["errors"] = ErrorsRecord(sides);
  record["causes"] = CausesRecord(sides);
  record["changed"] = ChangedRecord(sides);
  int clear = 0;
  for (const Json& value : record["values"])
    clear += value["runs"].back()["clear"] == Json(true) ? 1 : 0;
  record["clear_changes"] = clear;
  record["sentence"] = Sentence(record);
  return record;
}

std::string ComparisonTable(const Json& record) {
  CsvText csv({"value", "unit", "run", "found", "low95", "high95", "difference", "difference_low95",
               "difference_high95", "z"});
  for (const Json& value : record["values"]) {
    for (std::size_t i = 0; i < value["runs"].size(); ++i) {
      const Json& own = value["runs"][i];
      csv.Cell(TextAt(value, "/name")).Cell(TextAt(value, "/unit"));
      csv.Cell(TextAt(record["runs"][i], "/name"));
      for (const char* key : {"/value", "/ci95/0", "/ci95/1", "/difference", "/difference_ci95/0",
                              "/difference_ci95/1", "/z"})
        csv.Cell(NumberAt(own, key));
      csv.EndRow();
    }
  }
  return csv.text();
}

}  // namespace hoplab
