#include "app/reports/identify_report.h"

#include <fmt/format.h>

#include <cmath>

#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"

namespace hoplab {
namespace {

using Align = TextTable::Align;

// "rolling explicit, damping_rate hip, liftoff rest_length"; what is as in `thesis` is left out.
std::string ReadingText(const StudyReading& reading) {
  std::string text;
  const auto add = [&](std::string_view key, std::string_view word) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, word);
  };
  for (const ReadingKey& key : ReadingKeys()) {
    const int word = key.get(reading.law);
    if (word != 0) add(key.key, key.words[static_cast<std::size_t>(word)]);
  }
  if (reading.liftoff == LiftoffRule::kRestLength) add("liftoff", "rest_length");
  return text.empty() ? "as in the equation sheet" : text;
}

// "9.3 %"; "-" where a run has no steady hop.
std::string PercentOf(double fraction) {
  return std::isnan(fraction) ? "-" : Fixed(100.0 * fraction, 1) + " %";
}

std::string TimesText(const char* table, const TimeScores& t) {
  return fmt::format("table {} {} of {} converge, times {} s rms, rank correlation {}", table,
                     t.converged, t.of, Fixed(t.rms_s, 2), Fixed(t.rank_correlation, 2));
}

std::string ScoresText(const StudyScores& s) {
  return fmt::format(
      "table 6.5 {} points rms (worst {}); stiffness ranges of 6.3, 6.4 within {} (rms {}); {}; "
      "{}; {}; {}",
      Fixed(s.energy_rms, 3), Fixed(s.energy_worst, 2), PercentOf(s.stiffness_worst),
      PercentOf(s.stiffness_rms), TimesText("6.1", s.times[0]), TimesText("6.2", s.times[1]),
      TimesText("6.3", s.times[2]), TimesText("6.4", s.times[3]));
}

std::string ConstantsTable(const IdentificationRequest& request, const IdentificationResult& result,
                           bool colours) {
  TextTable table(
      {Align::kLeft, Align::kRight, Align::kRight, Align::kRight, Align::kRight, Align::kLeft});
  table.AddRow({"", "all tables", "least", "greatest", "6.5 alone", "unit"});
  std::vector<StudyConstant> shown = request.free;
  shown.insert(shown.end(), request.toe_free.begin(), request.toe_free.end());
  for (StudyConstant c : shown) {
    const StudyConstantInfo& info = InfoOf(c);
    const bool in_energy = IsInEnergy(c) && !NeedsToeMass(c);
    table.AddRow({std::string(info.name), Significant(At(result.by_all[0].fit.constants, c), 4),
                  Significant(At(result.low, c), 4), Significant(At(result.high, c), 4),
                  in_energy ? Significant(At(result.best_by_energy.fit.constants, c), 4) : "-",
                  std::string(info.unit)});
  }
  return WithHeader(table.Lines(), colours);
}

std::string DecisionsTable(const IdentificationResult& result, bool colours) {
  TextTable table({Align::kLeft, Align::kLeft, Align::kRight, Align::kRight, Align::kRight});
  table.AddRow({"open point", "word", "6.5 rms", "steady hops", "all tables"});
  for (const PointDecision& decision : result.decisions) {
    bool first = true;
    for (const PointDecision::Word& w : decision.words) {
      table.AddRow({first ? decision.point : "", w.word,
                    Fixed(kEnergyUnit * std::sqrt(w.energy_misfit), 3),
                    Significant(w.steady_misfit, 4), Significant(w.all_misfit, 4)});
      first = false;
    }
  }
  return WithHeader(table.Lines(), colours);
}

std::string FrontLines(const IdentificationResult& result, bool colours) {
  TextTable table({Align::kLeft, Align::kRight, Align::kRight, Align::kRight, Align::kRight,
                   Align::kRight, Align::kRight});
  table.AddRow(
      {"front", "6.5 points", "ranges within", "6.1 rms s", "6.2 rms s", "6.3 rms s", "6.4 rms s"});
  for (const FrontPoint& point : result.front) {
    const StudyScores& s = point.fit.scores;
    table.AddRow({point.name, Fixed(s.energy_rms, 3), PercentOf(s.stiffness_worst),
                  Fixed(s.times[0].rms_s, 2), Fixed(s.times[1].rms_s, 2),
                  Fixed(s.times[2].rms_s, 2), Fixed(s.times[3].rms_s, 2)});
  }
  return WithHeader(table.Lines(), colours);
}

// The combination of constants that a set of tables says least about: powers whose product stays.
std::string WeakestText(const IdentificationRequest& request,
                        const std::vector<StudyDirection>& directions, bool in_energy) {
  if (directions.empty()) return "-";
  std::string text;
  for (const StudyDirection& d : directions) {
    if (d.strength >= 1.0) continue;
    std::string loadings;
    for (std::size_t i = 0; i < request.free.size(); ++i) {
      if (std::abs(d.loadings[i]) < 0.1) continue;
      if (in_energy && !IsInEnergy(request.free[i])) continue;
      loadings += fmt::format("{}{} {}", loadings.empty() ? "" : ", ", InfoOf(request.free[i]).name,
                              Fixed(d.loadings[i], 2));
    }
    if (loadings.empty()) continue;
    text +=
        fmt::format("{}{} ({})", text.empty() ? "" : "; ", Significant(d.strength, 2), loadings);
  }
  return text.empty() ? "every combination" : "all but " + text;
}

std::string CellsText(const IdentificationResult& result) {
  constexpr std::size_t kShown = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, result.cells.size()); ++i) {
    const PullingCell& cell = result.cells[i];
    text += fmt::format("{}{} {} at {} ({} for {} {})", text.empty() ? "" : "; ",
                        NameOf(cell.table), cell.quantity, cell.at, Significant(cell.ours, 4),
                        Significant(cell.printed, 4), cell.unit);
  }
  return text.empty() ? "-" : text;
}

}  // namespace

std::string IdentifyReport(const IdentificationRequest& request, const IdentificationResult& result,
                           bool colours) {
  std::string text = Styled("published study", Emphasis::kBold, colours) +
                     "  constants and reading of its law, from its tables\n";
  text +=
      fmt::format("  {} readings, {} evaluations\n\n", request.readings.size(), result.evaluations);
  if (result.by_all.empty()) return text + "  nothing was found\n";
  const ScoredFit& best = result.by_all.front();
  text += ConstantsTable(request, result, colours) + "\n";
  text += Labelled("best",
                   ReadingText(best.fit.reading) + "; times by " + NameOf(best.convergence) + ": " +
                       ScoresText(best.scores),
                   colours);
  if (!result.by_energy.empty())
    text += Labelled(
        "6.5 alone",
        fmt::format("{}: {} points rms (worst {})", ReadingText(result.best_by_energy.fit.reading),
                    Fixed(result.best_by_energy.scores.energy_rms, 3),
                    Fixed(result.best_by_energy.scores.energy_worst, 2)),
        colours);
  text += Labelled("as good",
                   fmt::format("{} within twice the best misfit; least and greatest are theirs",
                               Plural(result.as_good, "fit")),
                   colours);
  text += Labelled("6.5 decides", WeakestText(request, result.energy_directions, true), colours);
  text += Labelled("with k", WeakestText(request, result.smooth_directions, false), colours);
  text += Labelled("pulls", CellsText(result), colours);
  if (!result.front.empty()) text += "\n" + FrontLines(result, colours);
  text += "\n" + DecisionsTable(result, colours) + "\n";
  return text;
}

}  // namespace hoplab
