#include "app/reports/design_report.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "app/records/design_record.h"
#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "base/text.h"
#include "fitting/design/forecast.h"

namespace hoplab {
namespace {

using enum TextTable::Align;

std::string RecordedText(const DesignRun& run) {
  if (!run.separates) {
    const SharedParameter& s = run.Sharpened();
    const double value = run.model.shared[run.parameter];
    const ReadableUnit unit = ReadableUnitOf(value, s.unit);
    const double half = run.search.before;
    return fmt::format("{} = {} {} {}", s.name, Significant(value * unit.factor, 4),
                       std::isfinite(half) ? "-+ " + Significant(half * unit.factor, 2)
                                           : std::string("(not determined)"),
                       unit.unit);
  }
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < run.rivals.size(); ++i)
    parts.push_back(
        fmt::format("{} with probability {:.3f}", RivalName(run.rivals[i]), run.probabilities[i]));
  std::string text = Join(parts);
  if (run.even_odds)
    text += "; they tell these apart already, so what follows counts from even odds";
  return text;
}

std::string OutcomesText(const DesignRun& run) {
  std::map<std::string, int> failures;
  for (const DesignTried& tried : run.search.tried) {
    if (tried.failure) ++failures[tried.failure->Sentence()];
  }
  std::string text = Plural(static_cast<long>(run.search.tried.size()), "design") + " tried";
  std::vector<std::string> ends;
  for (const auto& [failure, count] : failures)
    ends.push_back(fmt::format("{} ({})", count, failure));
  return ends.empty() ? text : text + "; cannot be simulated: " + Join(ends);
}

std::string BestTable(const DesignRun& run, bool colours) {
  std::vector<TextTable::Align> align = {kRight};
  std::vector<std::string> header = {""};
  for (const DesignRange& range : run.space.ranges) {
    const DesignSettingInfo& info = InfoOf(range.setting);
    align.push_back(kRight);
    header.push_back(fmt::format("{} {}", info.name, info.unit));
  }
  const bool separates = run.separates;
  ReadableUnit unit;
  if (!separates) {
    unit = ReadableUnitOf(run.model.shared[run.parameter], run.Sharpened().unit);
    align.insert(align.end(), {kRight, kRight});
    header.insert(header.end(), {"-+ " + unit.unit, "narrower by"});
  } else {
    align.insert(align.end(), {kRight, kRight, kLeft});
    header.insert(header.end(),
                  {"doubt left", "nats", run.rivals.size() > 2 ? "if true, against" : "if true"});
  }
  TextTable table(align);
  table.AddRow(header);
  int place = 0;
  for (const DesignTried& tried : run.search.best) {
    std::vector<std::string> cells = {std::to_string(++place)};
    for (const DesignRange& range : run.space.ranges)
      cells.push_back(
          Significant(ValueOf(tried.design, range.setting) / InfoOf(range.setting).si, 3));
    if (separates) {
      cells.push_back(BitsText(tried.log_left));
      cells.push_back(Significant(tried.pair_nats, 3));
      cells.push_back(tried.pair_truth + (run.rivals.size() > 2 ? ", " + tried.pair_other : ""));
    } else {
      cells.push_back(std::isfinite(tried.half_width)
                          ? Significant(tried.half_width * unit.factor, 3)
                          : "not seen");
      cells.push_back(fmt::format("{:.0f} %", std::floor(100.0 * tried.worth)));
    }
    table.AddRow(cells);
  }
  return WithHeader(table.Lines(), colours);
}

}  // namespace

std::string DesignReport(const Dataset& dataset, const DesignRun& run, bool colours) {
  std::string text = Styled(dataset.name, Emphasis::kBold, colours) + "  " + dataset.title + "\n";
  if (run.search.best.empty()) return text;
  text += "\n  " + Wrapped(DesignSentence(run), 2) + "\n\n";
  if (!run.decision.empty()) text += Labelled("why", run.decision, colours);
  text += Labelled("recorded", RecordedText(run), colours);
  text += Labelled("like",
                   fmt::format("{} in all that is not listed, for {} s", run.space.like.file,
                               Significant(run.space.like.row_times.back(), 3)),
                   colours);
  text += "\n" + BestTable(run, colours) + "\n";
  if (run.search.best.front().fragile)
    text += Labelled("careful", "these designs fall where a setting is a little off", colours);
  text += Labelled("search", OutcomesText(run), colours);
  return text;
}

}  // namespace hoplab
