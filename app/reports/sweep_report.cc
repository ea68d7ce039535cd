#include "app/reports/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"

namespace hoplab {
namespace {

std::string LastPart(const std::string& key) { return key.substr(key.rfind('.') + 1); }

}  // namespace

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
  header.emplace_back("outcome");
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
