#include "app/reports/comparison_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/records/json_at.h"
#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "base/text.h"

namespace hoplab {
namespace {

using enum TextTable::Align;

double Number(const Json& value) { return value.is_number() ? value.get<double>() : std::nan(""); }
std::string Text(const Json& value) { return value.is_string() ? value.get<std::string>() : ""; }

// "22.79", with two digits of the interval.
std::string ValueText(const Json& own, double factor) {
  const double value = Number(own["value"]);
  if (std::isnan(value)) return "-";
  if (!own["ci95"].is_array()) return Significant(value * factor, 4);
  const double half = 0.5 * factor * (Number(own["ci95"][1]) - Number(own["ci95"][0]));
  return FixedOrMore(value * factor, DecimalsFor(half));
}

std::string PairText(const Json& pair, double factor) {
  if (!pair.is_array()) return "";
  const double low = factor * Number(pair[0]), high = factor * Number(pair[1]);
  const int decimals = DecimalsFor(0.5 * (high - low));
  return FixedOrMore(low, decimals) + " .. " + FixedOrMore(high, decimals);
}

// One line a value and run.
std::vector<std::string> ValueLines(const Json& record) {
  TextTable table({kLeft, kRight, kRight, kLeft, kLeft, kRight, kLeft, kRight, kLeft});
  table.AddRow({"", "run", "value", "95 % interval", "unit", "change", "95 %", "z", ""});
  for (const Json& value : record["values"]) {
    double size = 0.0;
    for (const Json& own : value["runs"]) {
      if (size == 0.0 && own["value"].is_number()) size = Number(own["value"]);
    }
    const ReadableUnit unit = ReadableUnitOf(size, Text(value["unit"]));
    for (std::size_t i = 0; i < value["runs"].size(); ++i) {
      const Json& own = value["runs"][i];
      const double change = Number(own["difference"]), z = Number(own["z"]);
      const Json& range = own["difference_ci95"];
      const int decimals =
          range.is_array() ? DecimalsFor(0.5 * unit.factor * (Number(range[1]) - Number(range[0])))
                           : -1;
      std::string shown;
      if (std::isfinite(change))
        shown = decimals < 0 ? Significant(change * unit.factor, 3)
                             : FixedOrMore(change * unit.factor, decimals);
      table.AddRow({i == 0 ? Text(value["name"]) : "", std::to_string(i + 1),
                    ValueText(own, unit.factor), PairText(own["ci95"], unit.factor), unit.unit,
                    shown, PairText(range, unit.factor), std::isnan(z) ? "" : Significant(z, 2),
                    own["clear"] == Json(true) ? "clear" : ""});
    }
  }
  return table.Lines();
}

// One column a run.
TextTable RunsTable(const Json& record, const std::string& first) {
  std::vector<TextTable::Align> columns = {kLeft};
  std::vector<std::string> header = {first};
  for (std::size_t i = 0; i < record["runs"].size(); ++i) {
    columns.push_back(kLeft);
    header.push_back(std::to_string(i + 1));
  }
  TextTable table(columns);
  table.AddRow(header);
  return table;
}

std::vector<std::string> ErrorLines(const Json& record) {
  TextTable table = RunsTable(record, "errors");
  for (const Json& error : record["errors"]) {
    const std::string channel = Text(error["channel"]), unit = Text(error["unit"]);
    std::vector<std::string> cells = {Text(error["what"]) +
                                      (channel.empty() ? "" : " " + WithoutUnit(channel))};
    for (const Json& value : error["values"])
      cells.push_back(value.is_number() ? ErrorText(value.get<double>(), unit) : "-");
    table.AddRow(cells);
  }
  return table.Lines();
}

// "eta 0.046, 96 % of the misfit, probability 0.89".
std::string NamedCauseText(const Json& own) {
  if (own["found"] != Json(true))
    return own["looked_for"] == Json(true) ? "not found" : "not looked for";
  std::vector<std::string> parts;
  for (const Json& p : own["parameters"]) {
    const ReadableUnit unit = ReadableUnitOf(Number(p["value"]), Text(p["unit"]));
    parts.push_back(Text(p["name"]) + " " + Significant(Number(p["value"]) * unit.factor, 3) +
                    (unit.unit.empty() ? "" : " " + unit.unit));
  }
  if (own["share"].is_number())
    parts.push_back(Significant(100.0 * Number(own["share"]), 2) + " % of the misfit");
  if (own["probability"].is_number())
    parts.push_back("probability " + Significant(Number(own["probability"]), 2));
  return Join(parts);
}

std::string SettingText(const Json& value) {
  if (value.is_null() || (value.is_structured() && value.empty())) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  std::vector<std::string> parts;
  if (value.is_array()) {
    for (const Json& each : value) parts.push_back(SettingText(each));
    return Join(parts);
  }
  if (!value.is_object()) return value.dump();
  for (const auto& [key, each] : value.items()) parts.push_back(key + " = " + SettingText(each));
  return Join(parts);
}

// One line a name and run, wrapped: texts may be long.
std::vector<std::string> NamedLines(const std::string& title, const Json& entries,
                                    const std::string& name, const std::string& values,
                                    const auto& text_of) {
  std::size_t width = title.size();
  for (const Json& entry : entries) width = std::max(width, Text(entry[name]).size());
  std::vector<std::string> lines = {"  " + title};
  for (const Json& entry : entries) {
    for (std::size_t i = 0; i < entry[values].size(); ++i) {
      const std::string begin =
          fmt::format("  {:<{}}  {}  ", i == 0 ? Text(entry[name]) : "", width, i + 1);
      lines.push_back(begin + Wrapped(text_of(entry[values][i]), begin.size(), kReportWidth));
    }
  }
  return lines;
}

}  // namespace

std::string ComparisonReport(const Json& record, bool colours) {
  std::string text = Styled("comparison", Emphasis::kBold, colours) + "  " +
                     Wrapped(Text(record["sentence"]), 12, kReportWidth) + "\n";
  for (std::size_t i = 0; i < record["runs"].size(); ++i) {
    const Json& run = record["runs"][i];
    text += fmt::format("  {}  {}: {} of {}, law {}", i + 1, Text(run["name"]),
                        Text(run["command"]), Text(run["dataset"]), Text(run["law"]));
    if (run["verdict"].is_string()) text += ", " + Text(run["verdict"]);
    if (Text(run["status"]) != "ok") text += ", " + Text(run["status"]);
    text += "\n";
  }
  const auto part = [&](const std::vector<std::string>& lines) {
    if (lines.size() < 2) return;
    text += "\n" + Styled(lines.front(), Emphasis::kFaint, colours) + "\n";
    for (std::size_t i = 1; i < lines.size(); ++i) text += lines[i] + "\n";
  };
  part(ValueLines(record));
  part(ErrorLines(record));
  part(NamedLines("causes", record["causes"], "name", "runs", NamedCauseText));
  part(NamedLines("set otherwise", record["changed"], "key", "values", SettingText));
  return text + "\n";
}

}  // namespace hoplab
