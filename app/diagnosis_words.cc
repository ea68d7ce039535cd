#include "app/diagnosis_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/quantity.h"
#include "base/text.h"

namespace hoplab {
namespace {

constexpr double kLeastChance = 1e-3;
// Said once, beside the names.
std::string Caveat(bool several) {
  return fmt::format("(or something outside the catalogue that moves the data like {})",
                     several ? "them" : "it");
}

// "a", "a and b", "a, b and c".
std::string Listed(const std::vector<std::string>& words) {
  if (words.size() < 2) return Join(words);
  const std::vector<std::string> first(words.begin(), words.end() - 1);
  return Join(first) + " and " + words.back();
}

std::vector<std::string> NamesOf(const Diagnosis& d, const std::vector<int>& places) {
  std::vector<std::string> names;
  for (const int place : places)
    names.push_back(CauseText(d.naming.candidates[static_cast<std::size_t>(place)].candidate));
  return names;
}

// How far the models of a group are from the accepted one [nats].
std::string SpreadText(const Diagnosis& d, std::size_t group) {
  double spread = 0.0;
  if (group < d.naming.rivals.size()) {
    for (const Extension& rival : d.naming.rivals[group])
      spread = std::max(spread, std::abs(rival.cost - d.naming.best.cost));
  }
  return fmt::format("within {:.1f} nats", spread);
}

// The channel whose held-out error falls most: "the test error of body_x from 8.85 to 1.20 mm".
std::optional<std::string> ErrorChange(const Diagnosis& d) {
  const std::vector<double>&before = d.before.test.rmse, &after = d.extension->after.test.rmse;
  std::size_t best = before.size();
  for (std::size_t c = 0; c < std::min(before.size(), after.size()); ++c) {
    if (!std::isfinite(before[c]) || !std::isfinite(after[c])) continue;
    if (best == before.size() || after[c] / before[c] < after[best] / before[best]) best = c;
  }
  if (best == before.size()) return std::nullopt;
  const std::string name(NameOf(d.problem.channels[best].channel));
  const std::string unit = ChannelUnit(*ChannelFromName(name));
  const std::string to = ErrorText(after[best], unit);
  std::string from = ErrorText(before[best], unit);
  if (const std::size_t blank = from.find(' '); to.ends_with(from.substr(blank + 1)))
    from.resize(blank);
  return fmt::format("the test error of {} from {} to {}", WithoutUnit(name), from, to);
}

// What the held-out trials say of the extension, after a semicolon.
std::string HeldOutClause(const Diagnosis& d, const std::string& it) {
  const HeldOutGain& gain = d.extension->gain;
  if (d.extension->after.test.trials == 0) return "; there is no held-out trial to confirm it";
  if (!gain.ci95) return "; the held-out hops are too few to claim a gain";
  if (!gain.IsClaim()) return "; the held-out trials do not confirm it, so no gain is claimed";
  if (const std::optional<std::string> change = ErrorChange(d))
    return fmt::format("; adding {} takes {}", it, *change);
  return fmt::format("; adding {} gains {:.3g} nats a sample on the held-out trials", it,
                     gain.nats_per_sample);
}

std::string NamedSentence(const Diagnosis& d) {
  const std::vector<Candidate>& members = d.naming.best.members;
  std::vector<std::string> names;
  for (const Candidate& c : members) names.push_back(CauseText(c));
  // While misfit remains, a member may stand in for what is really missing.
  if (d.extension && d.extension->InDoubt()) {
    const ExtensionReport& e = *d.extension;
    return fmt::format(
        "{:.1f} % of what the simulation misses is explained by {} {}{}; something {}, so {} may "
        "stand in for another cause.",
        std::floor(1e3 * e.explained) / 10.0, Listed(names), Caveat(members.size() > 1),
        HeldOutClause(d, members.size() == 1 ? "it" : "them"),
        e.SomeRemains() ? "remains"
                        : fmt::format("may remain ({})", ChanceText(e.remainder.p_value)),
        members.size() == 1 ? "it" : "one of these");
  }
  std::string text = "The simulation lacks " + Listed(names) + " " + Caveat(members.size() > 1);
  if (members.size() == 1) text += ": " + std::string(members[0].effect->info.sentence);
  return text + HeldOutClause(d, members.size() == 1 ? "it" : "them") + ".";
}

std::string ConfoundedSentence(const Diagnosis& d) {
  const std::vector<std::vector<int>>& groups = d.naming.groups;
  if (groups.size() == 1) {
    return fmt::format("Cannot tell: {} explain these hops equally well, {} {}{}.",
                       Listed(NamesOf(d, groups[0])), SpreadText(d, 0), Caveat(true),
                       HeldOutClause(d, "the first"));
  }
  std::vector<std::string> certain, open;
  for (std::size_t m = 0; m < groups.size(); ++m) {
    const std::vector<std::string> names = NamesOf(d, groups[m]);
    if (names.size() == 1)
      certain.push_back(names[0]);
    else
      open.push_back("one of " + Listed(names) + " (" + SpreadText(d, m) + ")");
  }
  certain.insert(certain.end(), open.begin(), open.end());
  return fmt::format("The simulation lacks {}, which these hops cannot tell apart {}{}.",
                     Join(certain, "; "), Caveat(true), HeldOutClause(d, "the first of each"));
}

}  // namespace

std::string VerdictSentence(const Diagnosis& d) {
  if (!d.refusal.empty() || d.interrupted) return "";
  switch (d.verdict) {
    case Verdict::kAdequate:
      if (d.detection.p_value <= kDetectionLevel)
        return fmt::format("Nothing in the catalogue is needed: {} ({}).", d.reason,
                           ChanceText(d.detection.p_value));
      return fmt::format("Nothing is missing that these data could show ({}).",
                         ChanceText(d.detection.p_value));
    case Verdict::kNamed:
      return NamedSentence(d);
    case Verdict::kConfounded:
      return ConfoundedSentence(d);
    case Verdict::kUnexplained:
      return "Something is missing, and nothing in the catalogue explains it: " + d.reason + ".";
  }
  return "";
}

std::string SizeText(double value, const std::string& unit) {
  const ReadableUnit readable = ReadableUnitOf(value, unit);
  const std::string number = Significant(value * readable.factor, 2);
  return readable.unit.empty() ? number : number + " " + readable.unit;
}

std::string ChanceText(double p_value) {
  if (std::isnan(p_value)) return "p not computed";
  if (p_value < kLeastChance) return "p < 0.001";
  return "p = " + Significant(p_value, 2);
}

std::string PlaceText(const FitProblem& problem, const MisfitCell& cell) {
  const std::string channel =
      cell.channel < 0 ? "contact times"
                       : WithoutUnit(std::string(NameOf(
                             problem.channels[static_cast<std::size_t>(cell.channel)].channel)));
  std::string mode(NameOf(cell.mode));
  if (cell.mode == Mode::kRolling || cell.mode == Mode::kToe) mode += " stance";
  const std::string when = cell.phase == "middle" ? "in the middle of " : cell.phase + " in ";
  return channel + " " + when + mode;
}

std::string CauseText(const Candidate& candidate) {
  const std::string name(candidate.effect->info.name);
  return candidate.only_recording.empty()
             ? name
             : name + " (in " + Printable(candidate.only_recording) + " only)";
}

}  // namespace hoplab
