#include "app/records/diagnosis_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "app/records/fit_words.h"
#include "app/terminal/quantity.h"
#include "base/text.h"
#include "fitting/diagnosis/verdict.h"

namespace hoplab {
namespace {

constexpr double kLeastChance = 1e-3;
constexpr double kNothingExplained = 0.005;  // of the misfit, by the best attempt
constexpr double kLoneChannel = 0.9;         // of the misfit, in one channel alone
constexpr int kMostWords = 30;               // of a first sentence
constexpr std::size_t kMostNamed = 3;        // in it, fewer where it gets too long
constexpr double kSmoothMatters = 0.01;      // of the misfit, left as a smooth error

// The first few, and how many more.
std::string FirstOf(std::vector<std::string> words, std::size_t most) {
  if (words.size() <= most) return Listed(words);
  const std::size_t more = words.size() - most;
  words.resize(most);
  return Join(words) + fmt::format(" and {} more", more);
}

long WordsOf(const std::string& text) {
  return text.empty() ? 0 : 1 + std::count(text.begin(), text.end(), ' ');
}

// The sentence with as many names as thirty words hold.
std::string Shortened(const std::function<std::string(std::size_t most)>& sentence) {
  for (std::size_t most = kMostNamed; most > 1; --most) {
    if (std::string text = sentence(most); WordsOf(text) <= kMostWords) return text;
  }
  return sentence(1);
}

std::vector<std::string> CauseTexts(const Diagnosis& d, const std::vector<int>& places) {
  std::vector<std::string> names;
  for (const int place : places)
    names.push_back(CauseText(d.naming.candidates[static_cast<std::size_t>(place)].candidate));
  return names;
}

// "8.85 to 1.20 mm".
std::string FromTo(double before, double after, const std::string& unit) {
  const std::string to = ErrorText(after, unit);
  std::string from = ErrorText(before, unit);
  if (const std::size_t blank = from.find(' '); to.ends_with(from.substr(blank + 1)))
    from.resize(blank);
  return from + " to " + to;
}

// The channel whose held-out error falls most: "the test error of body_x from 8.85 to 1.20 mm";
// where none falls, that of the touch-downs if it does.
std::optional<std::string> ErrorChange(const Diagnosis& d) {
  constexpr double kFalls = 0.9;
  const std::vector<double>&before = d.before.test.rmse, &after = d.extension->after.test.rmse;
  std::size_t best = before.size();
  for (std::size_t c = 0; c < std::min(before.size(), after.size()); ++c) {
    if (!std::isfinite(before[c]) || !std::isfinite(after[c])) continue;
    if (best == before.size() || after[c] / before[c] < after[best] / before[best]) best = c;
  }
  const double landed = d.before.features.touchdown_time_rmse,
               lands = d.extension->after.features.touchdown_time_rmse;
  const bool falls = best < before.size() && after[best] < kFalls * before[best];
  if (!falls && lands < kFalls * landed)
    return "the test error of touch-down times from " + FromTo(landed, lands, "s");
  if (best == before.size()) return std::nullopt;
  const std::string name(NameOf(d.problem.channels[best].channel));
  return fmt::format("the test error of {} from {}", WithoutUnit(name),
                     FromTo(before[best], after[best], ChannelUnit(*ChannelFromName(name))));
}

// What the held-out trials say of the extension.
std::string HeldOutClause(const Diagnosis& d) {
  const HeldOutGain& gain = d.extension->gain;
  if (d.extension->after.test.trials == 0) return "no held-out trial confirms it";
  if (!gain.ci95) return "too little is held out to claim a gain";
  const std::vector<const CauseReport*> told = d.extension->ToldCauses();
  const bool elsewhere = !told.empty() && std::none_of(told.begin(), told.end(), [](const auto* c) {
    return c->cause.in_all();
  });
  if (!gain.IsClaim() && elsewhere)
    return gain.ci95->second < 0.0 ? "held-out trials are missed by more: some may have it, too"
                                   : "held-out trials cannot confirm what acts in those alone";
  if (!gain.IsClaim()) return "held-out trials do not confirm it";
  if (const std::optional<std::string> change = ErrorChange(d)) return "it takes " + *change;
  return fmt::format("it gains {:.3g} nats a held-out sample", gain.nats_per_sample);
}

// "air_drag", "a or b", "one of a, b and 2 more".
std::string GroupText(const Diagnosis& d, const CauseReport& c, std::size_t most) {
  const std::vector<int>& group = d.naming.GroupOf(c.candidate);
  if (group.size() < 2) return CauseText(c.cause);
  const std::vector<std::string> names = CauseTexts(d, group);
  return group.size() == 2 && most > 1 ? names[0] + " or " + names[1]
                                       : "one of " + FirstOf(names, most);
}

// Whether something that is not listed acts beside the causes that are told, since something stands
// in for it. That says nothing against them.
bool ActsBeside(const ExtensionReport& e) { return e.Probability() < e.ToldProbability(); }

// "The simulation lacks a (91 %) and b or c (5 %); it takes the test error of ..".
std::string CausesSentence(const Diagnosis& d, std::size_t most) {
  const ExtensionReport& e = *d.extension;
  const std::vector<const CauseReport*> told = e.ToldCauses();
  std::vector<std::string> names;
  double shares = 0.0;
  for (const CauseReport* c : told) {
    shares += e.OfMisfit(c->share);
    std::string name = GroupText(d, *c, most);
    if (told.size() > 1 && most > 1) name += fmt::format(" ({})", ShareText(e.OfMisfit(c->share)));
    names.push_back(std::move(name));
  }
  const double told_probability = e.ToldProbability();
  const bool sure = told_probability >= kSure;
  // How little it is, where it is.
  const double misfit = MisfitOverNoise(d.detection);
  std::string text = !sure && !ActsBeside(e) && misfit > 0.0 && misfit < kSlight
                         ? fmt::format("The simulation is off by {:.2f} of the noise and ", misfit)
                         : "The simulation ";
  text += sure ? "lacks " : told_probability >= kLikely ? "probably lacks " : "may lack ";
  text += FirstOf(names, most);
  std::string rest;
  if (!sure) rest += fmt::format(" (P {:.2f})", told_probability);
  if (ActsBeside(e))
    rest += fmt::format(" and something not listed (P {:.2f})", 1.0 - e.Probability());
  rest += "; " + HeldOutClause(d) + ".";
  // What each explains alone beside the others is little where they do much the same.
  const std::string together = fmt::format(", together {}", ShareText(e.explained));
  const bool little = told.size() > 1 && told.size() == e.causes.size() && names.size() <= most &&
                      shares < 0.5 * e.explained;
  return little && WordsOf(text + together + rest) <= kMostWords ? text + together + rest
                                                                 : text + rest;
}

// ", 97 % of it in leg_angle_1" where the simulation follows all other channels.
std::string LoneChannelClause(const Diagnosis& d) {
  const std::vector<ChannelProblem>& channels = d.problem.channels;
  if (channels.size() < 2) return "";
  std::vector<double> shares(channels.size(), 0.0);
  for (const MisfitCell& cell : d.localisation.cells)
    if (cell.channel >= 0) shares[static_cast<std::size_t>(cell.channel)] += cell.share;
  const auto most = std::max_element(shares.begin(), shares.end());
  if (*most < kLoneChannel) return "";
  const Channel channel = channels[static_cast<std::size_t>(most - shares.begin())].channel;
  return ", " + ShareText(*most) + " of it in " + WithoutUnit(std::string(NameOf(channel)));
}

std::string UnexplainedSentence(const Diagnosis& d, std::size_t most) {
  const std::string missing =
      "Something is missing that the catalogue does not hold" + LoneChannelClause(d);
  if (!d.extension) return missing + ".";
  const ExtensionReport& e = *d.extension;
  if (e.explained < kNothingExplained && !e.IsBeyondPhysics())
    return missing + ", and no cause in it explains any of the misfit.";
  std::vector<std::string> names, groups;
  double share = 0.0;
  for (const CauseReport* c : e.ToldCauses()) {
    names.push_back(CauseText(c->cause));
    groups.push_back(GroupText(d, *c, most));
    share += e.OfMisfit(c->share);
  }
  if (e.ToldProbability() >= kLikely && ActsBeside(e) && !e.IsBeyondPhysics())
    return fmt::format("{}; {} (P {:.2f}) {} {} of the misfit.", missing, FirstOf(groups, most),
                       e.ToldProbability(), groups.size() > 1 ? "explain" : "explains",
                       ShareText(share));
  return fmt::format("{}; the best attempt, {}, {}.", missing, FirstOf(names, most),
                     e.IsBeyondPhysics() ? WhatItNeeds(e)
                                         : "explains " + ShareText(e.explained) + " of the misfit");
}

// "a smooth error of body_x 2.51 mm over 262 ms" that is left beside what looks like noise; empty
// where there is none.
std::string SmoothLeft(const Diagnosis& d) {
  const FitProblem& problem = d.naming.best.problem;
  return problem.noise.IsWhite() ? "" : "a smooth error of " + LeftText(problem);
}

// Whether that smooth error is more than the noise of some channel, or much of the misfit.
bool SmoothMatters(const Diagnosis& d) {
  const FitProblem& problem = d.naming.best.problem;
  if (problem.noise.IsWhite() || !(d.extension->explained < 1.0)) return false;
  if (1.0 - d.extension->explained > kSmoothMatters) return true;
  for (std::size_t c = 0; c < problem.channels.size(); ++c)
    if (problem.noise.AmplitudeOf(c) > 1.0) return true;
  return false;
}

// "90.7 % of the misfit is explained, not all of it", not rounded up to all of it.
std::string NotAllText(const ExtensionReport& e) {
  return fmt::format("{:.1f} % of the misfit is explained, not all of it",
                     std::floor(1e3 * e.explained) / 10.0);
}

}  // namespace

std::string RemainderSentence(const Diagnosis& d) {
  const ExtensionReport& e = *d.extension;
  const Detection& r = e.remainder;
  const std::string chance = " (" + ChanceText(r.p_value) + ")";
  if (!e.SomeRemains()) {
    const std::string noise = e.InDoubt() ? " may be noise or not" : " looks like noise";
    const std::string smooth = SmoothLeft(d);
    if (smooth.empty()) return "what is left" + noise + chance;
    const std::string rest = "beside " + smooth + " the rest" + noise + chance;
    return SmoothMatters(d) ? NotAllText(e) + ": " + rest : rest;
  }
  std::string text = NotAllText(e) + chance;
  const auto most = std::max_element(
      r.tests.begin() + static_cast<std::ptrdiff_t>(r.candidates), r.tests.end(),
      [](const DetectionTest& a, const DetectionTest& b) { return a.statistic < b.statistic; });
  if (most != r.tests.end() && most->dof > 0)
    text += fmt::format("; a free {} would take up most of the rest", most->name);
  return text;
}

// Nothing is missing but in one channel.
std::string OddChannelSentence(const OddChannel& odd, const std::string& chance) {
  const std::string name = WithoutUnit(std::string(NameOf(odd.channel)));
  if (!odd.offset_s)
    return fmt::format("{} disagrees with the other channels, in which nothing is missing ({}).",
                       name, chance);
  return fmt::format("Nothing is missing but that {} is {} {} ({}).", name,
                     SizeText(std::abs(*odd.offset_s), "s"), *odd.offset_s < 0.0 ? "late" : "early",
                     chance);
}

std::string VerdictSentence(const Diagnosis& d) {
  if (!d.refusal.empty() || d.interrupted) return "";
  switch (d.verdict) {
    case Verdict::kAdequate:
      if (d.odd_channel) return OddChannelSentence(*d.odd_channel, ChanceText(d.detection.p_value));
      if (d.detection.p_value <= kDetectionLevel)
        return fmt::format("Nothing in the catalogue is needed: {} ({}).", d.reason,
                           ChanceText(d.detection.p_value));
      return fmt::format("Nothing is missing that these data could show ({}).",
                         ChanceText(d.detection.p_value));
    case Verdict::kNamed:
    case Verdict::kConfounded:
      return Shortened([&](std::size_t most) { return CausesSentence(d, most); });
    case Verdict::kUnexplained:
      return Shortened([&](std::size_t most) { return UnexplainedSentence(d, most); });
  }
  return "";
}

std::string ShareText(double share) {
  // Not rounded up to all of it.
  const double percent = 100.0 * std::clamp(share, 0.0, 1.0);
  if (percent > 0.0 && percent < 0.1) return "under 0.1 %";
  return percent < 10.0 ? fmt::format("{:.1f} %", percent)
                        : fmt::format("{:.0f} %", std::floor(percent));
}

std::string SizeText(double value, const std::string& unit) {
  const ReadableUnit readable = ReadableUnitOf(value, unit);
  const std::string number = Significant(value * readable.factor, 2);
  return readable.unit.empty() ? number : number + " " + readable.unit;
}

std::string WholeShareText(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

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
  if (candidate.each_trial) return name + " of each trial's own size";
  if (candidate.in_all()) return name;
  if (candidate.only_recordings.size() > kMostNamed)
    return name + fmt::format(" in {} trials", candidate.only_recordings.size());
  std::vector<std::string> files;
  for (const std::string& file : candidate.only_recordings) files.push_back(Printable(file));
  return name + " in " + Listed(files);
}

std::string ValuesText(const FitProblem& problem, const Eigen::VectorXd& shared,
                       const Uncertainty& uncertainty) {
  std::vector<std::string> values;
  const bool is_assessed =
      std::any_of(uncertainty.parameters.begin(), uncertainty.parameters.end(),
                  [](const ParameterUncertainty& u) { return u.ci95.has_value(); });
  for (int k = 0; k < problem.shared_count(); ++k) {
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(k)];
    const ParameterUncertainty& u = uncertainty.parameters[static_cast<std::size_t>(k)];
    const ReadableUnit unit = ReadableUnitOf(shared[k], s.unit);
    std::string text = s.name + " " + Significant(shared[k] * unit.factor, 4);
    // Where the model misses more than noise the trials say how far a value may be off.
    if (const auto& interval = uncertainty.misfit ? u.Wider() : u.ci95)
      text += fmt::format(" ({} .. {})", Significant(interval->first * unit.factor, 4),
                          Significant(interval->second * unit.factor, 4));
    if (!unit.unit.empty()) text += " " + unit.unit;
    if (u.at_bound)
      text += " (the end of its range)";
    else if (!u.ci95 && is_assessed)
      text = s.name + " not determined";
    values.push_back(std::move(text));
  }
  return Join(values);
}

}  // namespace hoplab
