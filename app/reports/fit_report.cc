#include "app/reports/fit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/records/fit_words.h"
#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "base/text.h"

namespace hoplab {
namespace {

struct Interval {
  double low, high;
  double half_width() const { return 0.5 * (high - low); }
};
std::optional<Interval> IntervalOf(const std::optional<std::pair<double, double>>& pair) {
  if (!pair) return std::nullopt;
  return Interval{pair->first, pair->second};
}

std::string IntervalText(const std::optional<Interval>& interval, double factor, int decimals) {
  if (!interval) return "";
  return FixedOrMore(interval->low * factor, decimals) + " .. " +
         FixedOrMore(interval->high * factor, decimals);
}

std::string FitSentence(const FitRun& run) {
  long train = 0, test = 0, samples = 0;
  for (const TrialProblem& t : run.problem.trials) {
    ++(t.role == TrialRole::kTrain ? train : test);
    if (t.role == TrialRole::kTrain) samples += t.sample_count;
  }
  return fmt::format("  law {}, {}{} train and {}, {}", NameOf(run.problem.law),
                     run.by_hop ? "fitted hop by hop, " : "", train,
                     Plural(test, run.by_hop ? "test hop" : "test trial"),
                     Plural(samples, "train sample"));
}

// One line a shared parameter.
std::vector<std::string> ParameterLines(const FitRun& run) {
  using enum TextTable::Align;
  TextTable table({kLeft, kRight, kLeft, kLeft, kLeft, kRight, kLeft});
  const bool misfit = run.uncertainty->misfit;
  table.AddRow({"", "value", "95 % interval",
                !misfit      ? ""
                : run.by_hop ? "between hops"
                             : "between trials",
                "unit", "start", ""});
  for (int i = 0; i < run.problem.shared_count(); ++i) {
    const SharedParameter& s = run.problem.shared[i];
    const ParameterUncertainty& u = run.uncertainty->parameters[i];
    const double value = run.fit.shared[i];
    const ReadableUnit unit = ReadableUnitOf(run.Undetermined(i) ? s.initial : value, s.unit);
    const std::string start = Significant(s.initial * unit.factor, 4);
    if (run.Undetermined(i)) {
      table.AddRow({s.name, "-", "not determined", "", unit.unit, start, ""});
      continue;
    }
    const std::optional<Interval> noise = IntervalOf(u.ci95);
    const std::optional<Interval> between =
        misfit ? IntervalOf(u.ci95_between_trials) : std::nullopt;
    // Two digits of the interval that counts, at least one of the other.
    const int decimals =
        std::max(noise ? DecimalsFor(noise->half_width() * unit.factor) - (between ? 1 : 0) : 0,
                 between ? DecimalsFor(between->half_width() * unit.factor) : 0);
    table.AddRow(
        {s.name,
         noise ? FixedOrMore(value * unit.factor, decimals) : Significant(value * unit.factor, 4),
         noise ? IntervalText(noise, unit.factor, decimals) : "none",
         IntervalText(between, unit.factor, decimals), unit.unit, start,
         u.at_bound ? "at bound" : ""});
  }
  return table.Lines();
}

std::string ErrorLine(const FitRun& run, const RoleErrors& errors) {
  if (errors.trials == 0) return "no such trials";
  if (errors.incomplete > 0) {
    return fmt::format("not computed: {} of {} simulations ended before their data",
                       errors.incomplete, errors.trials);
  }
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < run.problem.channels.size(); ++c) {
    const std::string name(NameOf(run.problem.channels[c].channel));
    const std::string unit = ChannelUnit(*ChannelFromName(name));
    parts.push_back(WithoutUnit(name) + " " + ErrorText(errors.rmse[c], unit));
  }
  return parts.empty() ? "contact times only" : Join(parts);
}

std::string NoteLines(const Dataset& dataset, const FitRun& run, bool colours) {
  std::string text;
  for (const std::string& warning : run.warnings) text += Labelled("warning", warning, colours);
  for (const std::string& fault :
       FaultSentences(dataset, run.problem.trace_faults, run.problem.keeps_stray))
    text += Labelled("note", fault, colours);
  if (!run.note.empty()) text += Labelled("note", run.note, colours);
  for (const std::string& remark : Remarks(run)) text += Labelled("note", remark, colours);
  return text;
}

}  // namespace

std::string FitReport(const Dataset& dataset, const FitRun& run, bool colours) {
  std::string text = Styled(Printable(dataset.name, 100), Emphasis::kBold, colours);
  if (!dataset.title.empty()) text += "  " + Printable(dataset.title, 100);
  text += "\n" + FitSentence(run) + "\n";
  if (!run.has_result) return text + Labelled("no result", run.Failure(), colours);
  if (!run.faults.empty()) {
    text += "\n";
    for (const std::string& fault : run.faults) text += Labelled("stuck", fault, colours);
    std::vector<std::string> stops;
    for (int i = 0; i < run.problem.shared_count(); ++i) {
      const SharedParameter& s = run.problem.shared[i];
      const ReadableUnit unit = ReadableUnitOf(run.fit.shared[i], s.unit);
      stops.push_back(fmt::format("{} {} {}", s.name,
                                  Significant(run.fit.shared[i] * unit.factor, 3), unit.unit));
    }
    text += Labelled(
        "no result",
        "the search stopped at " + Join(stops) + ", which is no minimum and no estimate", colours);
    return text + NoteLines(dataset, run, colours);
  }
  if (const std::string caveat = run.Caveat(); !caveat.empty())
    text += Labelled("not whole", caveat, colours);
  text += "\n";
  text += WithHeader(ParameterLines(run), colours) + "\n";

  const Uncertainty& u = *run.uncertainty;
  if (u.misfit) text += Labelled("misfit", MisfitLine(run.problem, u), colours);
  text += Labelled("determined", DeterminedLine(run.problem, u, ""), colours);
  for (const TrialRole role : {TrialRole::kTrain, TrialRole::kTest}) {
    text += Labelled(role == TrialRole::kTrain ? "train error" : "test error",
                     ErrorLine(run, Summarise(run.problem, run.trials, role)), colours);
  }
  text += Labelled("gradients", CertificateLine(run.certificate), colours);
  for (const Profile& p : run.profiles) {
    const SharedParameter& s = run.problem.shared[p.parameter];
    const ReadableUnit unit = ReadableUnitOf(run.fit.shared[p.parameter], s.unit);
    const double width = p.lower95 && p.upper95 ? 0.5 * (*p.upper95 - *p.lower95) : 0.0;
    const int decimals = DecimalsFor(width * unit.factor);
    const auto side = [&](const std::optional<double>& v) {
      return v ? FixedOrMore(*v * unit.factor, decimals) : std::string("open");
    };
    text += Labelled(
        "profile",
        fmt::format("{}: {} .. {} {}", s.name, side(p.lower95), side(p.upper95), unit.unit),
        colours);
  }
  if (const std::string known = run.problem.known.Text(); !known.empty())
    text += Labelled("known", known, colours);
  text += NoteLines(dataset, run, colours);
  return text;
}

}  // namespace hoplab
