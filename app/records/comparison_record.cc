#include "app/records/comparison_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "app/records/compared_side.h"
#include "app/records/comparison_values.h"
#include "app/records/csv.h"
#include "app/terminal/quantity.h"
#include "base/text.h"

namespace hoplab {
namespace {

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
        for (const char* key : {"probability", "share", "share_of_misfit", "parameters"})
          found[key] = JsonAt(cause, std::string("/") + key);
      }
      runs.push_back(found);
    }
    out.push_back({{"name", name}, {"runs", runs}});
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
