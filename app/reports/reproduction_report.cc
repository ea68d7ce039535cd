#include "app/reports/reproduction_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "base/text.h"
#include "base/units.h"

namespace hoplab {
namespace {

constexpr std::size_t kIndent = 4;

// A number as people read it: degrees, GPa, and no digits that say nothing.
std::string Shown(const StudyNumber& number) {
  if (number.unit == "rad")
    return std::abs(number.value) < 1e-6 ? Significant(number.value, 2) + " rad"
                                         : Significant(RadToDeg(number.value), 4) + " deg";
  const ReadableUnit unit = number.unit == "Pa" ? ReadableUnitOf(number.value, number.unit)
                                                : ReadableUnit{1.0, number.unit};
  const std::string value = std::isnan(number.value)
                                ? std::string("none")
                                : fmt::format("{:.4g}", number.value * unit.factor);
  return value + (unit.unit.empty() ? "" : " " + unit.unit);
}

std::string NumbersText(const std::vector<StudyNumber>& numbers) {
  std::vector<std::string> words;
  for (const StudyNumber& number : numbers) {
    std::string name = number.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    words.push_back(name + " " + Shown(number));
  }
  return Join(words);
}

std::string Heading(const std::string& name, const std::string& title, StudyVerdict verdict,
                    const std::vector<StudyCheck>& checks, bool colours) {
  const auto holding = std::count_if(checks.begin(), checks.end(),
                                     [](const StudyCheck& check) { return check.holds; });
  const bool reproduced = verdict == StudyVerdict::kReproduced;
  const std::string said(NameOf(verdict));
  std::string text = Styled(name, Emphasis::kBold, colours) + "  " +
                     (reproduced ? said : Styled(said, Emphasis::kWarning, colours));
  if (!reproduced) text += fmt::format(" ({} of {} checks hold)", holding, checks.size());
  return text + "\n" + std::string(kIndent, ' ') + Wrapped(title, kIndent) + "\n";
}

std::string CheckLines(const std::vector<StudyCheck>& checks, bool colours) {
  constexpr std::size_t kWord = 7;
  std::string text;
  for (const StudyCheck& check : checks) {
    const std::string word = fmt::format("{:<{}}", check.holds ? "holds" : "fails", kWord);
    std::string said = check.statement;
    if (!check.numbers.empty()) said += ": " + NumbersText(check.numbers);
    text += std::string(kIndent, ' ') +
            (check.holds ? word : Styled(word, Emphasis::kWarning, colours)) +
            Wrapped(said, kIndent + kWord) + "\n";
  }
  return text;
}

std::string TableText(const StudyTable& table, bool colours) {
  using enum TextTable::Align;
  std::string text = Heading(table.name, table.title, table.verdict, table.checks, colours);
  text += CheckLines(table.checks, colours);
  text += std::string(kIndent, ' ') + Wrapped(NumbersText(table.statistics), kIndent) + "\n";
  TextTable numbers({kLeft, kLeft, kRight, kRight, kLeft, kLeft});
  numbers.AddRow({"cell", "quantity", "published", "ours", "unit", ""});
  const auto value = [](double v, const std::string& unit) {
    return std::isnan(v) ? std::string("none") : Fixed(v, unit == "N/m" ? 0 : unit == "%" ? 2 : 1);
  };
  for (const ComparedNumber& n : table.numbers) {
    std::string quantity = n.quantity;
    std::replace(quantity.begin(), quantity.end(), '_', ' ');
    numbers.AddRow({NumbersText(n.at), quantity, value(n.published, n.unit), value(n.ours, n.unit),
                    n.unit, n.agrees() ? "agrees" : "differs"});
  }
  return text + WithHeader(numbers.Lines(), colours) + "\n";
}

// "law consistent, law no_slip" among the alternatives where all checks hold.
std::string WhereAllHold(const StudyClaim& claim) {
  std::vector<std::string> settings;
  for (const ClaimAlternative& other : claim.alternatives) {
    if (std::find(other.holds.begin(), other.holds.end(), false) == other.holds.end())
      settings.push_back(other.setting);
  }
  return Join(settings);
}

std::string ClaimText(const StudyClaim& claim, bool colours) {
  std::string text = Heading(claim.name, claim.statement, claim.verdict, claim.checks, colours);
  text += CheckLines(claim.checks, colours);
  const std::string pad(kIndent, ' ');
  if (!claim.alternatives.empty()) {
    const std::string where = WhereAllHold(claim);
    std::vector<std::string> tried;
    for (const ClaimAlternative& other : claim.alternatives) tried.push_back(other.setting);
    text += pad +
            Wrapped(where.empty() ? "holds whole with none of: " + Join(tried)
                                  : "holds whole also with: " + where,
                    kIndent) +
            "\n";
  }
  if (!claim.remark.empty()) text += pad + Wrapped("note: " + claim.remark, kIndent) + "\n";
  return text + "\n";
}

std::string FigureLines(const std::vector<StudyFigure>& figures, bool colours) {
  using enum TextTable::Align;
  TextTable table({kLeft, kLeft, kLeft});
  table.AddRow({"figure", "shows", "ends"});
  for (const StudyFigure& figure : figures) {
    std::vector<std::string> ends;
    for (const StudyCurve& curve : figure.curves) {
      if (curve.settings)
        ends.push_back(fmt::format("{} {:.2f} s", curve.outcome, curve.end_time_s));
      else if (!curve.outcome.empty())
        ends.push_back(curve.outcome);
    }
    // Four jumps end alike; the first two say enough.
    if (ends.size() > 2) ends = {std::to_string(ends.size()) + " jumps"};
    table.AddRow({figure.name, figure.title, Join(ends)});
  }
  std::string text = WithHeader(table.Lines(), colours);
  for (const StudyFigure& figure : figures) {
    if (!figure.numbers.empty())
      text += "  " + Wrapped(figure.name + ": " + NumbersText(figure.numbers), kIndent) + "\n";
  }
  return text + "\n";
}

}  // namespace

std::string ReproductionReport(const std::string& name, const Reproduction& reproduction,
                               bool colours) {
  std::string text = Styled(name, Emphasis::kBold, colours) +
                     fmt::format("  {}, {}, {} of the published study\n\n",
                                 Plural(static_cast<long>(reproduction.tables.size()), "table"),
                                 Plural(static_cast<long>(reproduction.claims.size()), "claim"),
                                 Plural(static_cast<long>(reproduction.figures.size()), "figure"));
  for (const StudyTable& table : reproduction.tables) text += TableText(table, colours);
  for (const StudyClaim& claim : reproduction.claims) text += ClaimText(claim, colours);
  if (!reproduction.figures.empty()) text += FigureLines(reproduction.figures, colours);
  return text;
}

}  // namespace hoplab
