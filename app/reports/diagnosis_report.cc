#include "app/reports/diagnosis_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/records/carried_on_record.h"
#include "app/records/diagnosis_words.h"
#include "app/reports/cause_report.h"
#include "app/reports/discovery_report.h"
#include "app/reports/exclusion_report.h"
#include "app/reports/force_report.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "base/text.h"

namespace hoplab {
namespace {

using enum TextTable::Align;

// What is listed for a reader; the rest stands in the CSVs.
constexpr std::size_t kMostPlaces = 4, kMostHops = 4;
constexpr double kSmallShare = 0.05;

std::string DiagnosisSentence(const Diagnosis& d) {
  long train = 0, test = 0, samples = 0;
  for (const TrialProblem& t : d.problem.trials) {
    ++(t.role == TrialRole::kTrain ? train : test);
    if (t.role == TrialRole::kTrain) samples += t.sample_count;
  }
  return fmt::format("  law {}, {}{} train and {}, {}, {} tried\n", NameOf(d.problem.law),
                     d.by_hop ? "fitted hop by hop, " : "", train,
                     Plural(test, d.by_hop ? "test hop" : "test trial"),
                     Plural(samples, "train sample"),
                     Plural(static_cast<long>(d.naming.candidates.size()), "cause"));
}

// ---- where

std::string CellsLine(const Diagnosis& d) {
  std::vector<std::string> places;
  for (const MisfitCell& c : d.localisation.cells) {
    if (places.size() == kMostPlaces || c.share < kSmallShare) break;
    places.push_back(WholeShareText(c.share) + " " + PlaceText(d.problem, c));
  }
  return Join(places);
}

std::string PartsLine(const Diagnosis& d) {
  std::vector<MisfitPart> hops = d.localisation.hops, trials = d.localisation.trials;
  const auto by_share = [](const MisfitPart& a, const MisfitPart& b) { return a.share > b.share; };
  std::stable_sort(hops.begin(), hops.end(), by_share);
  std::stable_sort(trials.begin(), trials.end(), by_share);
  std::vector<std::string> words;
  if (hops.size() > 1) {
    std::vector<std::string> parts;
    for (const MisfitPart& p : hops) {
      if (parts.size() < 3 && p.share >= kSmallShare)
        parts.push_back(fmt::format("{} hop {}", WholeShareText(p.share), p.index + 1));
    }
    if (!parts.empty()) words.push_back(Join(parts));
  }
  if (trials.size() > 1 && trials[0].share >= kSmallShare) {
    const std::vector<TrialProblem> train = TrialsOf(d.problem, TrialRole::kTrain);
    words.push_back(fmt::format("most in {} ({})",
                                train[static_cast<std::size_t>(trials[0].index)].file,
                                WholeShareText(trials[0].share)));
  }
  return Join(words, "; ");
}

// ---- held-out

std::string HeldOutTable(const Diagnosis& d, bool colours) {
  const HeldOutErrors& after = d.extension->after;
  TextTable table({kLeft, kRight, kRight});
  table.AddRow({"held-out error", "before", "after"});
  for (std::size_t c = 0; c < d.problem.channels.size(); ++c) {
    const std::string name(NameOf(d.problem.channels[c].channel));
    const std::string unit = ChannelUnit(*ChannelFromName(name));
    table.AddRow({WithoutUnit(name), ErrorText(d.before.test.rmse[c], unit),
                  ErrorText(after.test.rmse[c], unit)});
  }
  const auto feature = [&](const char* name, double old, double now, bool length) {
    if (!std::isfinite(old) && !std::isfinite(now)) return;
    const auto text = [&](double v) {
      if (std::isnan(v)) return std::string("-");
      return length ? ErrorText(v, "m") : Significant(1e3 * v, 3) + " ms";
    };
    table.AddRow({name, text(old), text(now)});
  };
  const FeatureErrors &b = d.before.features, &a = after.features;
  feature("apex height", b.apex_height_rmse, a.apex_height_rmse, true);
  feature("apex time", b.apex_time_rmse, a.apex_time_rmse, false);
  feature("touch-down time", b.touchdown_time_rmse, a.touchdown_time_rmse, false);
  feature("stance duration", b.stance_time_rmse, a.stance_time_rmse, false);
  return WithHeader(table.Lines(), colours);
}

// Of the model as it was.
std::string TestErrorLine(const Diagnosis& d) {
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < d.problem.channels.size(); ++c) {
    const std::string name(NameOf(d.problem.channels[c].channel));
    parts.push_back(WithoutUnit(name) + " " +
                    ErrorText(d.before.test.rmse[c], ChannelUnit(*ChannelFromName(name))));
  }
  return Join(parts);
}

std::string GainLine(const ExtensionReport& e) {
  const HeldOutGain& g = e.gain;
  if (std::isnan(g.nats_per_sample)) return "not computed: no held-out trial to compare on";
  std::string text = fmt::format("{:+.3g} nats a sample", g.nats_per_sample);
  text += g.ci95 ? fmt::format(", 95 % interval {:.3g} .. {:.3g}", g.ci95->first, g.ci95->second)
                 : std::string(", no interval from so little");
  text += fmt::format(" ({}, {})", Plural(g.hops, "hop"), Plural(g.samples, "sample"));
  if (!g.IsClaim()) text += ": no claim";
  if (!e.left_out.empty()) text += "; left out, not simulated to its end: " + Join(e.left_out);
  return text;
}

// Value `k` beside the causes that are told, with its interval: {"22.01", "21.88 .. 22.17"}.
std::array<std::string, 2> ValueAfter(const ExtensionReport& e, std::size_t k, double factor) {
  const double after = e.movements[k].after * factor;
  const std::string alone = Significant(after, 4);
  if (k >= e.uncertainty.parameters.size()) return {alone, ""};
  const ParameterUncertainty& u = e.uncertainty.parameters[k];
  if (u.at_bound) return {alone, "at its bound"};
  // Where the model misses more than noise the trials say how far a value may be off.
  const auto& interval = e.uncertainty.misfit ? u.Wider() : u.ci95;
  if (!interval) return {alone, "not determined"};
  const double low = interval->first * factor, high = interval->second * factor;
  const int decimals = DecimalsFor(0.5 * (high - low));
  return {FixedOrMore(after, decimals),
          FixedOrMore(low, decimals) + " .. " + FixedOrMore(high, decimals)};
}

std::string MovedTable(const ExtensionReport& e, bool colours) {
  TextTable table({kLeft, kRight, kRight, kLeft, kLeft, kLeft});
  table.AddRow({"parameter", "before", "after", "95 % interval", "unit", "moved by"});
  for (std::size_t k = 0; k < e.movements.size(); ++k) {
    const Movement& m = e.movements[k];
    const ReadableUnit unit = ReadableUnitOf(m.before, m.unit);
    const std::array<std::string, 2> after = ValueAfter(e, k, unit.factor);
    table.AddRow({m.name, Significant(m.before * unit.factor, 4), after[0], after[1], unit.unit,
                  m.std_errors ? fmt::format("{:+.{}f} standard errors", *m.std_errors,
                                             std::abs(*m.std_errors) < 10.0 ? 1 : 0)
                               : "not known: undetermined before"});
  }
  return e.movements.empty() ? "" : WithHeader(table.Lines(), colours);
}

std::string EnergyTable(const EnergyLedger& ledger, bool colours) {
  TextTable table({kLeft, kRight, kRight, kRight, kRight});
  table.AddRow({"energy lost", "from", "measured", "before", "after"});
  const auto lost = [](const HopBalance& b) {
    const double share = b.LossShare();
    return std::isnan(share) ? std::string("-") : fmt::format("{:.2f} %", 100.0 * share);
  };
  for (std::size_t k = 0; k < std::min(ledger.hops.size(), kMostHops); ++k) {
    const HopEnergy& h = ledger.hops[k];
    const double begin = std::isnan(h.measured.begin) ? h.before.begin : h.measured.begin;
    table.AddRow({fmt::format("hop {} of {}", k + 1, ledger.recording),
                  Significant(begin, 4) + " J", lost(h.measured), lost(h.before),
                  h.after ? lost(*h.after) : ""});
  }
  return WithHeader(table.Lines(), colours);
}

// ---- what next

std::string ExperimentLine(const Diagnosis& d) {
  const SeparatingExperiment& e = *d.experiment;
  if (!e.Separates()) {
    return fmt::format(
        "none of {} designs like {} would settle it: the best promises {:.1f} nats, {:.0f} are "
        "needed",
        e.designs_tried, e.design.like, e.expected_nats, kIndistinguishable);
  }
  // The first group that is one is what the search was for.
  std::string cause = "the cause";
  for (const std::vector<int>& group : d.naming.groups) {
    if (group.size() < 2) continue;
    cause = d.naming.candidates[static_cast<std::size_t>(group.front())].candidate.Name();
    break;
  }
  return fmt::format("{}, otherwise like {}: expected to set {} apart from {} by {} nats",
                     Describe(e.design), e.design.like, cause, e.closest_rival,
                     Significant(e.expected_nats, 2));
}

// What no cause of the list explains may have a formula.
std::string FormulaLine(const Diagnosis& d, bool formula_sought, bool colours) {
  if (d.verdict != Verdict::kUnexplained || formula_sought) return "";
  return Labelled("a formula", "hoplab discover looks for one: diagnose --discover does it at once",
                  colours);
}

// What a search that was stopped has of each cause alone.
std::string BestAlone(const Diagnosis& d, bool colours) {
  constexpr std::size_t kMost = 3;
  std::vector<const CandidateResult*> found;
  for (const CandidateResult& c : d.naming.candidates)
    if (c.alone.ok() && c.gain > 0.0) found.push_back(&c);
  if (found.empty()) return "";
  std::sort(found.begin(), found.end(),
            [](const CandidateResult* a, const CandidateResult* b) { return a->gain > b->gain; });
  found.resize(std::min(found.size(), kMost));
  std::vector<std::string> words;
  for (const CandidateResult* c : found) {
    const std::size_t first = d.null.problem.shared.size();
    words.push_back(fmt::format("{} {} ({:.0f} nats)", CauseText(c->candidate),
                                SizeText(c->alone.shared[static_cast<Eigen::Index>(first)],
                                         c->alone.problem.shared[first].unit),
                                c->gain));
  }
  return Labelled("so far", "what each explains alone, not yet weighed: " + Join(words), colours);
}

// What was tried together, of which it has the best.
std::string BestTogether(const Diagnosis& d, bool is_first, bool colours) {
  const FittedModel& best = d.naming.best;
  if (best.members.size() < 2 || !best.ok() || best.has_own_sizes()) return "";
  std::vector<std::string> words;
  std::size_t place = d.null.problem.shared.size();
  for (const Candidate& c : best.members) {
    words.push_back(fmt::format(
        "{} {}", CauseText(c),
        SizeText(best.shared[static_cast<Eigen::Index>(place)], best.problem.shared[place].unit)));
    place += static_cast<std::size_t>(c.parameter_count());
  }
  return Labelled(is_first ? "so far" : "",
                  "the best together, which may not be all: " + Join(words), colours);
}

std::string NoVerdict(const Diagnosis& d, const std::string& failure, bool colours) {
  std::string text = "\n" + Labelled("no verdict", failure, colours);
  for (const GateCheck& c : d.gate.checks) {
    // A fit that is no minimum may be diagnosed: an extension of it may be one.
    const bool in_doubt = c.name == "fit" && !d.gate.at_minimum;
    text += Labelled(!c.passed ? "failed" : (in_doubt ? "in doubt" : "passed"),
                     c.name + ": " + c.text, colours);
  }
  if (!d.interrupted) return text;
  const std::string alone = BestAlone(d, colours);
  text += alone + BestTogether(d, alone.empty(), colours);
  for (const std::string& note : d.notes) text += Labelled("note", note, colours);
  return text;
}

}  // namespace

std::string DiagnosisReport(const Dataset& dataset, const DiagnosisRun& run, bool formula_sought,
                            bool colours) {
  const Diagnosis& d = run.diagnosis;
  std::string text = Styled(Printable(dataset.name, 100), Emphasis::kBold, colours);
  if (!dataset.title.empty()) text += "  " + Printable(dataset.title, 100);
  text += "\n" + DiagnosisSentence(d);
  if (const std::string failure = run.Failure(); !failure.empty())
    return text + NoVerdict(d, failure, colours);

  text += "\n  " + Styled(Wrapped(VerdictSentence(d), 2), Emphasis::kBold, colours) + "\n\n";
  if (d.verdict != Verdict::kAdequate) {
    text += Labelled("misfit", CellsLine(d), colours);
    if (const std::string parts = PartsLine(d); !parts.empty())
      text += Labelled("", parts, colours);
    text += "\n";
  }
  if (d.extension) {
    const ExtensionReport& e = *d.extension;
    text += CauseLines(d, colours) + "\n";
    if (e.after.test.trials > 0) text += HeldOutTable(d, colours) + "\n";
    text += MovedTable(e, colours) + "\n";
    if (!run.energy.hops.empty()) text += EnergyTable(run.energy, colours) + "\n";
    if (d.carried_on) text += Labelled("whole trials", WholeTrialsSentence(*d.carried_on), colours);
    text += Labelled("gain", GainLine(e), colours);
    text += Labelled("remainder", RemainderSentence(d), colours);
    text += DoubtLines(d, colours);
  } else {
    if (!d.uncertainty.parameters.empty())
      text += Labelled("values", ValuesText(d.problem, d.null.shared, d.uncertainty), colours);
    if (d.before.test.trials > 0) text += Labelled("test error", TestErrorLine(d), colours);
    text += LeftOutLine(d, colours);
  }
  if (d.free_forces) text += ForceLines(*d.free_forces, colours);
  text += FormulaLine(d, formula_sought, colours);
  text += ExclusionLines(d, colours);
  if (d.experiment) text += Labelled("next trial", ExperimentLine(d), colours);
  for (const std::string& note : d.notes) text += Labelled("note", note, colours);
  return text;
}

std::string FormulaReport(const DiagnosisRun& run, const std::optional<Discovery>& discovery,
                          bool colours) {
  if (discovery) return "\n" + DiscoveryReport(*discovery, colours) + "\n";
  return run.Failure().empty() ? "\n  no formula is needed beside what was named\n" : "";
}

}  // namespace hoplab
