#include "app/reports/discovery_report.h"

#include <fmt/format.h>

#include "app/records/discovery_record.h"
#include "app/records/discovery_words.h"
#include "app/records/formula_words.h"
#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "base/text.h"

namespace hoplab {
namespace {

std::string Upper(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

std::string Percent(double share) { return Significant(100.0 * share, 2) + " %"; }

std::string Listed(const std::vector<const Effect*>& effects) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string> words;
  for (const Effect* e : effects) {
    if (words.size() == kMost) {
      words.push_back(fmt::format("and {} more", effects.size() - kMost));
      break;
    }
    words.push_back(SourceOf(*e)->acts_as + ": " + LineOf(*e->formula));
  }
  return Join(words, "; ");
}

std::string TermText(const FoundTerm& found, std::size_t place, bool colours) {
  const Effect& effect = FormulaEffect(found.source);
  std::string text = "\n  " + Styled(Upper(WordsOf(found)), Emphasis::kBold, colours) + "\n";
  text += Labelled(
      "formula",
      std::string(InfoOf(effect.formula->place()).symbol) + " + [" + LineOf(*effect.formula) + "]",
      colours);
  text += Labelled("size", SizesOf(found), colours);
  if (found.exponent) {
    const FoundValue& p = found.exponent->value;
    text += Labelled(
        "exponent",
        p.ci95 ? fmt::format("{} freed: {}, 95 % {} to {}", Significant(found.exponent->taken, 2),
                             Significant(p.value, 3), Significant(p.ci95->first, 3),
                             Significant(p.ci95->second, 3))
               : "freed: not determined",
        colours);
  }
  text += Labelled("explains", Percent(found.share) + " of the misfit beyond noise", colours);
  if (found.selected_in)
    text += Labelled("picked in", Percent(*found.selected_in) + " of the resamples of the trials",
                     colours);
  text += Labelled("physics", PhysicsOf(found), colours);
  if (!found.equal.empty()) text += Labelled("same here", Listed(found.equal), colours);
  if (!found.as_good.empty()) text += Labelled("as good", Listed(found.as_good), colours);
  return text + Labelled("file", DiscoveredFile(place) + ", for --with", colours);
}

std::string Errors(const Discovery& d) {
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < d.base.problem.channels.size(); ++c) {
    const std::string name(NameOf(d.base.problem.channels[c].channel));
    const std::string unit = ChannelUnit(*ChannelFromName(name));
    parts.push_back(WithoutUnit(name) + " " + ErrorText(d.base.before.test.rmse[c], unit) + " -> " +
                    ErrorText(d.after.test.rmse[c], unit));
  }
  return Join(parts);
}

}  // namespace

std::string DiscoveryReport(const Discovery& d, bool colours) {
  if (!FailureOf(d).empty()) return "";
  std::string text;
  const std::string verdict = d.verdict == DiscoveryVerdict::kFound       ? "a formula was found"
                              : d.verdict == DiscoveryVerdict::kNotNeeded ? "no formula is needed"
                                                                          : "no formula is stable";
  text +=
      "  " + Styled(Upper(verdict), Emphasis::kBold, colours) + ": " + Wrapped(d.reason, 2) + "\n";
  if (d.in_place_of_causes)
    text += Labelled("model", "without the causes above, which may only stand in for it", colours);
  if (d.library > 0)
    text += Labelled(
        "tried", fmt::format("{} terms, {} of them refitted", d.library, d.terms.size()), colours);
  for (std::size_t i = 0; i < d.found.size(); ++i) text += TermText(d.found[i], i, colours);
  if (!d.found.empty() && d.after.test.trials > 0 && d.base.before.test.trials > 0) {
    text += "\n" + Labelled("held out", Errors(d), colours);
    if (d.gain.ci95)
      text += Labelled(
          "gain",
          fmt::format("{} nats a sample, 95 % {} to {}", Significant(d.gain.nats_per_sample, 2),
                      Significant(d.gain.ci95->first, 2), Significant(d.gain.ci95->second, 2)),
          colours);
  }
  if (d.verdict == DiscoveryVerdict::kNothingStable && d.free_forces)
    text += Labelled("forces",
                     "what the missing part looks like: free_forces of run.json and the report",
                     colours);
  return text;
}

}  // namespace hoplab
