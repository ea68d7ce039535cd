#include <fmt/format.h>

#include <cmath>

#include "app/console.h"
#include "app/identify_record.h"
#include "app/quantity.h"
#include "app/report_text.h"
#include "app/text_table.h"

namespace hoplab {
namespace {

// "rolling explicit, damping_rate hip, liftoff rest_length"; what is as in `thesis` is left out.
std::string ReadingText(const StudyReading& reading) {
  std::string text;
  const auto add = [&](std::string_view key, std::string_view word) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, word);
  };
  for (const VariantKey& key : VariantKeys()) {
    const int word = key.get(reading.variant);
    if (word != 0) add(key.key, key.words[word]);
  }
  if (reading.liftoff == LiftoffRule::kRestLength) add("liftoff", "rest_length");
  return text.empty() ? "as in the equation sheet" : text;
}

// "9.3 %"; "-" where a run has no steady hop.
std::string PercentOf(double fraction) {
  return std::isnan(fraction) ? "-" : Fixed(100.0 * fraction, 1) + " %";
}

std::string ScoresText(const StudyScores& s) {
  return fmt::format(
      "table 6.5 {} points rms (worst {}); stiffness ranges of 6.3, 6.4 within {} (rms {}); table "
      "6.2 {} of 25 converge, rank correlation {}; table 6.4 {} of 10 converge, tau with E {}",
      Fixed(s.energy_rms, 3), Fixed(s.energy_worst, 2), PercentOf(s.stiffness_worst),
      PercentOf(s.stiffness_rms), s.converged_starts, Fixed(s.start_rank_correlation, 2),
      s.converged_moduli, Fixed(s.modulus_trend, 2));
}

std::string ConstantsTable(const IdentificationRequest& request, const IdentificationResult& result,
                           bool colours) {
  using Align = TextTable::Align;
  TextTable table(
      {Align::kLeft, Align::kRight, Align::kRight, Align::kRight, Align::kRight, Align::kLeft});
  table.AddRow({"", "all tables", "least", "greatest", "6.5 alone", "unit"});
  for (StudyConstant c : request.free) {
    const StudyConstantInfo& info = InfoOf(c);
    const bool in_energy = c != StudyConstant::kGain;
    table.AddRow({std::string(info.name), Significant(At(result.by_all[0].fit.constants, c), 4),
                  Significant(At(result.low, c), 4), Significant(At(result.high, c), 4),
                  in_energy ? Significant(At(result.best_by_energy.fit.constants, c), 4) : "-",
                  std::string(info.unit)});
  }
  return WithHeader(table.Lines(), colours);
}

std::string DecisionsTable(const IdentificationResult& result, bool colours) {
  using Align = TextTable::Align;
  TextTable table({Align::kLeft, Align::kLeft, Align::kRight, Align::kRight});
  table.AddRow({"open point", "word", "6.5 rms", "all tables"});
  for (const PointDecision& decision : result.decisions) {
    bool first = true;
    for (const PointDecision::Word& w : decision.words) {
      table.AddRow({first ? decision.point : "", w.word,
                    Fixed(kEnergyUnit * std::sqrt(w.energy_misfit), 3),
                    Significant(w.all_misfit, 4)});
      first = false;
    }
  }
  return WithHeader(table.Lines(), colours);
}

// The combination of constants that a set of tables says least about: powers whose product stays.
std::string WeakestText(const IdentificationRequest& request,
                        const std::vector<StudyDirection>& directions, bool without_gain) {
  std::string text;
  for (const StudyDirection& d : directions) {
    if (d.strength >= 1.0) continue;
    std::string loadings;
    for (std::size_t i = 0; i < request.free.size(); ++i) {
      if (std::abs(d.loadings[i]) < 0.1) continue;
      if (without_gain && request.free[i] == StudyConstant::kGain) continue;
      loadings += fmt::format("{}{} {}", loadings.empty() ? "" : ", ", InfoOf(request.free[i]).name,
                              Fixed(d.loadings[i], 2));
    }
    if (loadings.empty()) continue;
    text +=
        fmt::format("{}{} ({})", text.empty() ? "" : "; ", Significant(d.strength, 2), loadings);
  }
  return text.empty() ? "every combination" : "all but " + text;
}

}  // namespace

std::string IdentifyReport(const IdentificationRequest& request, const IdentificationResult& result,
                           bool colours) {
  const ScoredFit& best = result.by_all.front();
  std::string text = Styled("published study", Emphasis::kBold, colours) +
                     "  constants and reading of its law, from tables 6.2 to 6.5\n";
  text +=
      fmt::format("  {} readings, {} evaluations\n\n", request.readings.size(), result.evaluations);
  text += ConstantsTable(request, result, colours) + "\n";
  text += Labelled("best", ReadingText(best.fit.reading) + ": " + ScoresText(best.scores), colours);
  text += Labelled("6.5 alone",
                   ReadingText(result.best_by_energy.fit.reading) + ": " +
                       ScoresText(result.best_by_energy.scores),
                   colours);
  text += Labelled("as good",
                   fmt::format("{} within twice the best misfit; least and greatest are theirs",
                               Plural(result.as_good, "reading")),
                   colours);
  text += Labelled("6.5 decides", WeakestText(request, result.energy_directions, true), colours);
  text += Labelled("with k", WeakestText(request, result.smooth_directions, false), colours);
  text += "\n" + DecisionsTable(result, colours) + "\n";
  return text;
}

}  // namespace hoplab
