#include "app/reports/cause_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/records/diagnosis_words.h"
#include "app/records/fit_words.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "base/text.h"

namespace hoplab {
namespace {

using enum TextTable::Align;

constexpr std::size_t kMostTrials = 12;  // listed of a size that differs between trials

struct CauseInterval {
  std::optional<std::pair<double, double>> ci;
  bool at_bound = false;
  std::optional<double> spread;  // of sizes that are each trial's own
};

void AddCauseRow(TextTable& table, const SharedParameter& s, double value,
                 const CauseInterval& interval, const std::array<std::string, 2>& remarks) {
  const ReadableUnit unit =
      ReadableUnitOf(std::max(std::abs(value), interval.spread.value_or(0.0)), s.unit);
  std::string shown = Significant(value * unit.factor, 3), range;
  if (interval.ci) {
    const double half = 0.5 * (interval.ci->second - interval.ci->first) * unit.factor;
    const int decimals = DecimalsFor(half);
    shown = FixedOrMore(value * unit.factor, decimals);
    range = FixedOrMore(interval.ci->first * unit.factor, decimals) + " .. " +
            FixedOrMore(interval.ci->second * unit.factor, decimals);
  }
  if (interval.at_bound) range = "at its bound";
  if (interval.spread) {
    const double spread = *interval.spread * unit.factor;
    const int decimals = DecimalsFor(spread);
    shown = FixedOrMore(value * unit.factor, decimals);
    range = "spread " + FixedOrMore(spread, decimals) + " by trial";
    if (interval.at_bound) range += ", at its bound";
  }
  table.AddRow({s.name, shown, range, unit.unit, remarks[0], remarks[1]});
}

// Places of a candidate's values among the shared ones of a model that has it; -1: it has not.
int PlaceIn(const FittedModel& model, const Candidate& candidate) {
  int place = model.problem.shared_count() - model.parameter_count();
  for (const Candidate& member : model.members) {
    if (member == candidate) return place;
    place += member.parameter_count();
  }
  return -1;
}

// How far the evidence of a group's k-th model is behind the first's [nats].
double NatsBehind(const Naming& naming, std::size_t member, std::size_t k) {
  const std::vector<double>& weights = naming.group_weights[member];
  return std::log(weights[0] / weights[k]);
}

// One cause with its sizes, followed by what does as well in its place.
void AddCause(TextTable& table, const Diagnosis& d, const CauseReport& cause, bool between) {
  const Naming& naming = d.naming;
  const Uncertainty& u = d.extension->uncertainty;
  const std::size_t m = naming.MemberOf(cause.candidate);
  for (std::size_t k = 0; k < naming.groups[m].size(); ++k) {
    const CandidateResult& c = naming.candidates[static_cast<std::size_t>(naming.groups[m][k])];
    const bool rival = k > 0;
    if (rival && (m >= naming.rivals.size() || k >= naming.rivals[m].size())) continue;
    const FittedModel& model = rival ? naming.rivals[m][k] : naming.best;
    const int place = PlaceIn(model, c.candidate);
    if (place < 0) continue;
    for (int i = 0; i < c.candidate.parameter_count(); ++i) {
      const auto at = static_cast<std::size_t>(place) + static_cast<std::size_t>(i);
      CauseInterval interval;
      if (!rival) {
        const ParameterUncertainty& p = u.parameters[at];
        interval = {between ? p.ci95_between_trials : p.ci95, p.at_bound, std::nullopt};
        if (cause.cause.each_trial && cause.refitted.at(static_cast<std::size_t>(i)))
          interval.spread = cause.refitted[static_cast<std::size_t>(i)]->spread;
      }
      std::string share, chance;
      if (i == 0) {
        share = rival ? fmt::format("or: {:.1f} nats behind", NatsBehind(naming, m, k))
                      : ShareText(d.extension->OfMisfit(cause.share));
        chance = fmt::format("{:.2f}", rival ? cause.group_probability * naming.group_weights[m][k]
                                             : cause.probability);
      }
      AddCauseRow(table, model.problem.shared[at], model.shared[place + i], interval,
                  {share, chance});
    }
  }
}

// The told causes with their sizes, the largest share first.
std::string CauseTable(const Diagnosis& d, bool colours) {
  const ExtensionReport& e = *d.extension;
  const Uncertainty& u = e.uncertainty;
  const bool between =
      u.misfit && !u.parameters.empty() && u.parameters.back().ci95_between_trials.has_value();
  const char* title = d.verdict == Verdict::kUnexplained ? "best attempt"
                      : e.MainCauses().empty()           ? "small cause"
                                                         : "main cause";
  TextTable table({kLeft, kRight, kLeft, kLeft, kLeft, kRight});
  table.AddRow({title, "size",
                !between   ? "95 % interval"
                : d.by_hop ? "95 % between hops"
                           : "95 % between trials",
                "unit", "explains", "P"});
  for (const CauseReport* c : e.ToldCauses()) AddCause(table, d, *c, between);
  return WithHeader(table.Lines(), colours);
}

// Causes of no consequence for the misfit, in one line.
std::string SmallLine(const Diagnosis& d, bool colours) {
  std::vector<std::string> names;
  if (!d.extension->MainCauses().empty()) {
    for (const CauseReport& c : d.extension->causes) {
      if (!c.main && !c.stands_in)
        names.push_back(CauseText(c.cause) + " (" + ShareText(d.extension->OfMisfit(c.share)) +
                        ")");
    }
  }
  if (names.empty()) return "";
  return Labelled(
      "small",
      "corrections the data also want, which may stand for details of the model: " + Join(names),
      colours);
}

// What the model needs though its name is most likely wrong.
std::string StandInLine(const Diagnosis& d, bool colours) {
  std::vector<std::string> needed;
  for (const CauseReport& c : d.extension->causes) {
    if (c.stands_in)
      needed.push_back(fmt::format("{} ({}, P {:.2f})", CauseText(c.cause),
                                   ShareText(d.extension->OfMisfit(c.share)), c.group_probability));
  }
  if (needed.empty()) return "";
  return Labelled("stand-in",
                  "needed, but most likely in place of something not listed: " + Join(needed),
                  colours);
}

// "train-1.csv 0.3 N, ...", the first few.
std::string SizesText(const std::vector<double>& sizes, const std::vector<TrialProblem>& train,
                      const std::string& unit) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < sizes.size() && texts.size() < kMostTrials; ++i) {
    if (std::isfinite(sizes[i])) texts.push_back(train[i].file + " " + SizeText(sizes[i], unit));
  }
  return Join(texts);
}

// "in every trial, differently": one parameter of a cause that is told so.
std::string DifferentlyText(const CauseReport& c, std::size_t k,
                            const std::vector<TrialProblem>& train) {
  const VaryingValue& value = *c.refitted[k];
  const EffectParameter& p = c.cause.Parameter(static_cast<int>(k));
  const std::string unit(p.unit);
  std::string interval;
  if (value.ci95) {
    const ReadableUnit shown = ReadableUnitOf(value.mean, unit);
    const auto [low, high] = *value.ci95;
    const int decimals = DecimalsFor(0.5 * (high - low) * shown.factor);
    interval = fmt::format(" (95 % {} .. {})", FixedOrMore(low * shown.factor, decimals),
                           FixedOrMore(high * shown.factor, decimals));
  }
  return fmt::format("{}{} in every trial, differently: mean {}{}, spread {} ({}): {}",
                     c.cause.effect->info.name,
                     c.sizes.size() > 1 ? "." + std::string(p.name) : std::string(),
                     SizeText(value.mean, unit), interval, SizeText(value.spread, unit),
                     ChanceText(c.sizes[k].p_value), SizesText(value.sizes, train, unit));
}

// What sizes of each trial's own are worth.
std::string SizesWorthText(const Diagnosis& d) {
  const ExtensionReport& e = *d.extension;
  std::vector<std::string> errors;
  const std::vector<double>&before = e.after.test.rmse, &after = e.sizes->held_out_rmse;
  for (std::size_t c = 0; c < std::min(before.size(), after.size()); ++c) {
    const std::string name(ChannelName(d.problem.channels[c].channel));
    const std::string unit = ChannelUnit(*ChannelFromName(name));
    if (std::isfinite(before[c]) && std::isfinite(after[c]))
      errors.push_back(fmt::format("{} {} -> {}", WithoutUnit(name), ErrorText(before[c], unit),
                                   ErrorText(after[c], unit)));
  }
  return fmt::format(
      "with these sizes the causes explain {} of the misfit instead of {}{}{} ({:.1f} nats)",
      WholeShareText(e.sizes->explained), WholeShareText(e.explained),
      errors.empty() ? "" : ", held-out ", Join(errors), e.sizes->gain);
}

std::string VariesLines(const Diagnosis& d, bool colours) {
  const std::vector<TrialProblem> train = TrialsOf(d.problem, TrialRole::kTrain);
  std::string text;
  bool beside_the_model = false;
  for (const CauseReport* c : d.extension->ToldCauses()) {
    for (std::size_t k = 0; k < c->sizes.size(); ++k) {
      if (!d.extension->TellsSizesOf(*c, k)) continue;
      text += Labelled("varies", DifferentlyText(*c, k, train), colours);
      beside_the_model |= !c->cause.each_trial;
    }
  }
  if (beside_the_model) text += Labelled("", SizesWorthText(d), colours);
  return text;
}

// What the names mean.
std::string MeaningLines(const Diagnosis& d, bool colours) {
  std::vector<const Effect*> effects;
  for (const CauseReport* cause : d.extension->ToldCauses()) {
    for (const int place : d.naming.GroupOf(cause->candidate)) {
      const Effect* e = d.naming.candidates[static_cast<std::size_t>(place)].candidate.effect;
      if (std::find(effects.begin(), effects.end(), e) == effects.end()) effects.push_back(e);
    }
  }
  std::string text;
  for (const Effect* e : effects)
    text += Labelled(text.empty() ? "meaning" : "",
                     std::string(e->info.name) + ": " + std::string(e->info.sentence), colours);
  return text;
}

// "E 0.14 GPa less" of the value that moves most, in its standard errors; empty if by less than
// half of one.
std::string MovedText(const Diagnosis& d, const OtherModel& other) {
  double most = 0.5;
  std::string text;
  for (int k = 0; k < d.problem.shared_count(); ++k) {
    const auto& error = d.extension->uncertainty.parameters[static_cast<std::size_t>(k)].std_error;
    const double moved = std::abs(other.moved[k]);
    if (!error || !(moved > most * *error)) continue;
    most = moved / *error;
    const SharedParameter& s = d.problem.shared[static_cast<std::size_t>(k)];
    const ReadableUnit unit = ReadableUnitOf(moved, s.unit);
    text = fmt::format("{} {} {} {}", s.name, Significant(moved * unit.factor, 2), unit.unit,
                       other.moved[k] < 0.0 ? "less" : "more");
  }
  return text;
}

// Models that are not told and not ruled out, where a fitted value depends on them.
std::string OtherModelsLine(const Diagnosis& d, bool colours) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> texts;
  const auto candidate = [&](int place) -> const Candidate& {
    return d.naming.candidates[static_cast<std::size_t>(place)].candidate;
  };
  for (const OtherModel& other : d.extension->other_models) {
    const std::string moved = MovedText(d, other);
    if (moved.empty() || texts.size() == kMost) continue;
    const Candidate& c = candidate(other.candidate);
    const EffectParameter& p = c.Parameter(0);
    const std::string place =
        other.instead_of < 0 ? "" : " for " + CauseText(candidate(other.instead_of));
    texts.push_back(fmt::format("with {} {}{} {}", CauseText(c),
                                SizeText(p.null + other.size[0], std::string(p.unit)), place,
                                moved));
  }
  if (texts.empty()) return "";
  return Labelled("perhaps", "not told and not ruled out, so the intervals hold it: " + Join(texts),
                  colours);
}

std::string ValuesText(const Candidate& c, const Eigen::VectorXd& values) {
  std::vector<std::string> texts;
  for (int k = 0; k < c.parameter_count(); ++k) {
    const EffectParameter& p = c.Parameter(k);
    const std::string name = c.parameter_count() > 1 ? std::string(p.name) + " " : "";
    texts.push_back(name + SizeText(values[k], std::string(p.unit)));
  }
  return Join(texts);
}

// What is left out since the whole trials know it in another size.
std::string UnconfirmedLine(const Diagnosis& d, bool colours) {
  std::vector<std::string> texts;
  for (const SetAside& s : d.set_aside)
    if (s.by_whole_trials)
      texts.push_back(
          fmt::format("{} ({} of the misfit; {} by the first parts, {} by the whole trials)",
                      CauseText(s.cause), ShareText(s.of_misfit), ValuesText(s.cause, s.values),
                      ValuesText(s.cause, *s.by_whole_trials)));
  if (texts.empty()) return "";
  return Labelled("left out",
                  "of another size in the whole trials, so most likely standing for something "
                  "else: " +
                      Join(texts),
                  colours);
}

// What no cause explains, as the noise model sees it.
std::string LeftLine(const Diagnosis& d, bool colours) {
  if (d.left.noise.IsWhite()) return "";
  return Labelled("left",
                  fmt::format("a smooth error of {}, {} of the misfit",
                              LeftText(d.naming.best.problem), ShareText(d.left.share)),
                  colours);
}

// How sure the names are together.
std::string SureLine(const Diagnosis& d, bool colours) {
  const double unlisted = d.UnlistedProbability();
  return Labelled("unlisted",
                  fmt::format("P {:.2f} that the cause is outside the catalogue{}", unlisted,
                              CalibrationCases() > 0
                                  ? fmt::format(", by {} simulated cases", CalibrationCases())
                                  : std::string()),
                  colours);
}

}  // namespace

std::string CauseLines(const Diagnosis& d, bool colours) {
  return CauseTable(d, colours) + MeaningLines(d, colours) + VariesLines(d, colours) +
         SmallLine(d, colours) + StandInLine(d, colours) + LeftOutLine(d, colours) +
         UnconfirmedLine(d, colours) + OtherModelsLine(d, colours);
}

std::string LeftOutLine(const Diagnosis& d, bool colours) {
  constexpr double kUnlikely = 0.2;
  bool is_unlikely = true;
  std::vector<std::string> names;
  for (const SetAside& s : d.set_aside) {
    if (s.by_whole_trials) continue;
    is_unlikely = is_unlikely && s.probability < kUnlikely;
    names.push_back(fmt::format("{} ({}, P {:.2f})", CauseText(s.cause), ShareText(s.of_misfit),
                                s.probability));
  }
  if (names.empty()) return "";
  return Labelled("left out",
                  std::string(d.extension ? "would explain a little more" : "would explain some") +
                      (d.ShowsLateAlone() ? ", but is seen late alone, as a model's own error is: "
                       : is_unlikely      ? ", but most likely does not act: "
                                          : ", but more likely does not act than acts: ") +
                      Join(names),
                  colours);
}

std::string DoubtLines(const Diagnosis& d, bool colours) {
  return LeftLine(d, colours) + SureLine(d, colours);
}

}  // namespace hoplab
