#include "app/reports/law_comparison_report.h"

#include <fmt/format.h>

#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"
#include "base/text.h"
#include "fitting/problem.h"

namespace hoplab {
namespace {

std::string TextOf(const ComparedModel& model) {
  std::string text = model.law.empty() ? "default" : model.law;
  for (const std::string& effect : model.with_effects) text += " + " + effect;
  return text;
}

// "22.53 GPa (+2.4 %)": a value with its unit, and how far it is from a stated truth.
std::string ValueText(const ModelResult& row, int k, const std::map<std::string, double>& truth) {
  const SharedParameter& s = row.fit.problem.shared[k];
  const double value = row.fit.result.shared[k];
  const ReadableUnit unit = ReadableUnitOf(value, s.unit);
  std::string text = s.name + " " + Significant(value * unit.factor, 4);
  if (!unit.unit.empty()) text += " " + unit.unit;
  if (const auto known = truth.find(s.name); known != truth.end() && known->second != 0.0)
    text += fmt::format(" ({:+.1f} %)", 100.0 * (value / known->second - 1.0));
  return text;
}

std::string ErrorsText(const ModelResult& row, const RoleErrors& errors) {
  if (errors.trials == 0) return "-";
  if (errors.incomplete > 0) return fmt::format("{} fell", errors.incomplete);
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < errors.rmse.size(); ++c) {
    const std::string name(NameOf(row.fit.problem.channels[c].channel));
    parts.push_back(ErrorText(errors.rmse[c], ChannelUnit(*ChannelFromName(name))));
  }
  return Join(parts);
}

}  // namespace

std::string LawComparisonReport(const LawComparison& comparison,
                                const std::map<std::string, double>& truth) {
  using enum TextTable::Align;
  TextTable table({kLeft, kLeft, kLeft, kRight, kLeft});
  std::vector<std::string> channels;
  for (const ChannelProblem& c : comparison.rows.front().fit.problem.channels)
    channels.push_back(WithoutUnit(std::string(NameOf(c.channel))));
  table.AddRow({"model", "first value", "test error " + Join(channels), "chi2", ""});
  for (const ModelResult& row : comparison.rows) {
    if (!row.fit.result.ok) {
      table.AddRow({TextOf(row.model), "no fit", "", "", row.fit.result.message});
      continue;
    }
    table.AddRow({TextOf(row.model), ValueText(row, 0, truth), ErrorsText(row, row.test),
                  Significant(row.uncertainty.chi2_per_dof, 3),
                  row.fit.by_hop ? "hop by hop" : ""});
  }
  std::string text;
  for (const std::string& line : table.Lines()) text += line + '\n';
  for (const ModelResult& row : comparison.rows) {
    std::vector<std::string> others;
    for (int k = 1; row.fit.result.ok && k < row.fit.problem.shared_count(); ++k)
      others.push_back(ValueText(row, k, truth));
    if (!others.empty()) text += "  " + TextOf(row.model) + ": " + Join(others) + '\n';
    if (!row.fit.note.empty()) text += "    note: " + row.fit.note + '\n';
  }
  return text;
}

}  // namespace hoplab
