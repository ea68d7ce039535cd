#include "app/records/sweep_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "app/records/csv.h"
#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"

namespace hoplab {
namespace {

// How the run ended, and a sentence for those that did not reach their end.
constexpr const char* kOutcome = "outcome";
constexpr const char* kReason = "reason";

std::string LastPart(const std::string& key) { return key.substr(key.rfind('.') + 1); }

bool ReachedItsEnd(const SweepRow& row) { return row.reason.empty(); }

}  // namespace

std::string UnitOfKey(const std::string& key) {
  // The longest first: "_m" ends "_N_m" too.
  constexpr std::array<std::pair<const char*, const char*>, 14> kSuffixes = {
      {{"_N_m_s_per_rad", "N m s/rad"},
       {"_N_m_per_rad", "N m/rad"},
       {"_N_s_per_m", "N s/m"},
       {"_m_per_s2", "m/s^2"},
       {"_m_per_s", "m/s"},
       {"_N_per_m", "N/m"},
       {"_N_s", "N s"},
       {"_N_m", "N m"},
       {"_deg", "deg"},
       {"_Pa", "Pa"},
       {"_kg", "kg"},
       {"_m4", "m^4"},
       {"_m2", "m^2"},
       {"_m", "m"}}};
  if (key.ends_with("time_s")) return "s";
  for (const auto& [suffix, unit] : kSuffixes) {
    if (key.ends_with(suffix)) return unit;
  }
  return "";
}

void AddSweep(const SweepPlan& plan, const SweepRows& rows, Json& record) {
  record["columns"] = Json::array();
  const auto column = [&](std::string_view name, std::string_view unit) {
    record["columns"].push_back({{"name", name}, {"unit", unit}});
  };
  for (const std::string& key : plan.keys()) column(key, UnitOfKey(key));
  for (const SweepOutput* output : plan.outputs()) column(output->name, output->unit);
  column(kOutcome, "");
  column(kReason, "");
  record["keys"] = plan.keys();
  record["rows"] = Json::array();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i]) continue;
    Json cells = Json::array();
    for (const double value : plan.Point(static_cast<int>(i))) cells.push_back(value);
    for (const double value : rows[i]->values) cells.push_back(NumberOrNull(value));
    cells.push_back(rows[i]->outcome);
    cells.push_back(ReachedItsEnd(*rows[i]) ? Json(nullptr) : Json(rows[i]->reason));
    record["rows"].push_back(std::move(cells));
  }
  record["comparison"] = nullptr;
}

std::string SweepTable(const SweepPlan& plan, const SweepRows& rows) {
  std::vector<std::string> header = plan.keys();
  for (const SweepOutput* output : plan.outputs()) header.emplace_back(output->name);
  header.emplace_back(kOutcome);
  header.emplace_back(kReason);
  CsvText csv(header);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i]) continue;
    for (const double value : plan.Point(static_cast<int>(i))) csv.Cell(value);
    for (const double value : rows[i]->values) csv.Cell(value);
    csv.Cell(rows[i]->outcome).Cell(rows[i]->reason);
    csv.EndRow();
  }
  return csv.text();
}

std::string SweepReport(const SweepPlan& plan, const SweepRows& rows, bool colours) {
  constexpr std::size_t kShown = 30;
  std::map<std::string, int> outcomes;
  std::size_t done = 0;
  for (const auto& row : rows) {
    if (!row) continue;
    ++done;
    ++outcomes[row->outcome];
  }
  std::string ends;
  for (const auto& [outcome, count] : outcomes)
    ends += fmt::format("{}{} {}", ends.empty() ? "" : ", ", count, outcome);
  std::string text = Styled(plan.name(), Emphasis::kBold, colours) +
                     fmt::format("  law {}, {} rows: {}\n\n", NameOf(plan.law()), done, ends);
  std::vector<TextTable::Align> align(plan.keys().size() + plan.outputs().size(),
                                      TextTable::Align::kRight);
  align.push_back(TextTable::Align::kLeft);
  TextTable table(align);
  std::vector<std::string> header;
  for (const std::string& key : plan.keys()) header.push_back(LastPart(key));
  for (const SweepOutput* output : plan.outputs()) header.emplace_back(output->name);
  header.emplace_back(kOutcome);
  table.AddRow(header);
  for (std::size_t i = 0; i < std::min(rows.size(), kShown); ++i) {
    if (!rows[i]) continue;
    std::vector<std::string> cells;
    for (const double value : plan.Point(static_cast<int>(i)))
      cells.push_back(Significant(value, 6));
    for (const double value : rows[i]->values) cells.push_back(Significant(value, 5));
    cells.push_back(rows[i]->outcome);
    table.AddRow(cells);
  }
  const std::vector<std::string> lines = table.Lines();
  text += Styled(lines.front(), Emphasis::kFaint, colours) + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) text += lines[i] + "\n";
  if (rows.size() > kShown)
    text += fmt::format("  ... and {} more in rows.csv\n", rows.size() - kShown);
  return text;
}

}  // namespace hoplab
