// Two effects at once, an effect in one trial only, and the wrong sign.
// ctest -L statistics

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/random.h"
#include "tests/fitting/diagnosis/study.h"

namespace hoplab::testing {
namespace {

std::string SetsOf(const Outcome& o) {
  std::string sets = o.refusal.empty() ? std::string(NameOf(o.verdict)) : o.refusal;
  for (const auto& group : o.groups) {
    sets += " {";
    for (std::size_t i = 0; i < group.size(); ++i) sets += (i ? ", " : "") + group[i];
    sets += "}";
  }
  return sets;
}

void PrintCases(Report& report, const std::vector<Outcome>& outcomes) {
  report.Head({"law", "planted", "seed", "reported"});
  for (const Outcome& o : outcomes) {
    std::string planted;
    for (const PlantedEffect& e : o.truth.effects)
      planted += (planted.empty() ? "" : " + ") + e.name;
    report.Row({std::string(NameOf(o.truth.law)), planted,
                Cell("%llu", static_cast<unsigned long long>(o.truth.seed)), SetsOf(o)});
  }
}

TEST(DiagnosisStatistics, TwoEffectsAtOnceAreBothReported) {
  const int seeds = SeedCount(10);
  std::vector<Truth> truths;
  std::string absent;
  for (int pair = 0; pair < kPairCount; pair += EveryNth()) {
    for (int i = 0; i < seeds; ++i) {
      const auto truth = PlantPair(pair, i, 4.0);
      if (truth) truths.push_back(*truth);
      if (!truth && i == 0) absent += std::string(absent.empty() ? "" : ", ") + PairName(pair);
    }
  }
  const std::vector<Outcome> outcomes = RunAll(truths);
  Report report("5-two-effects", "Two effects at once");
  report.Say(
      "Ten fixed pairs, both effects at 4 delta80, %d seeds each; law and signs are drawn. "
      "No law carries: %s.",
      seeds, absent.empty() ? "none of them is missing" : absent.c_str());
  report.Head({"planted", "cases", "both in sets", "one of them", "wrong and alone", "unexplained",
               "adequate"});
  struct Counts {
    int cases = 0, both = 0, one = 0, wrong = 0, unexplained = 0, adequate = 0;
  };
  std::map<std::string, Counts> counts;
  Counts all;
  std::vector<Outcome> missed;
  for (const Outcome& o : outcomes) {
    const auto& effects = o.truth.effects;
    const int held = o.Holds(effects[0].name) + o.Holds(effects[1].name);
    for (Counts* c : {&counts[effects[0].name + " + " + effects[1].name], &all}) {
      ++c->cases;
      c->both += held == 2;
      c->one += held == 1;
      c->wrong += o.NamesWrongly();
      c->unexplained += o.verdict == Verdict::kUnexplained;
      c->adequate += o.verdict == Verdict::kAdequate;
    }
    if (held < 2) missed.push_back(o);
  }
  const auto row = [&](const std::string& name, const Counts& c) {
    const auto share = [&](int part) { return Cell("%.0f", PerCent(part, c.cases)); };
    report.Row({name, Cell("%d", c.cases), share(c.both), share(c.one), share(c.wrong),
                share(c.unexplained), share(c.adequate)});
  };
  for (const auto& [name, c] : counts) row(name, c);
  row("all", all);
  report.Say("Cases with less than both:");
  PrintCases(report, missed);
  EXPECT_TRUE(IsAtLeast(all.both, all.cases, 0.85)) << all.both << " of " << all.cases;
}

// Effects the rules are tried on.
constexpr std::array kRuleEffects = {"air_drag",       "gravity_scale", "touchdown_angle_bias",
                                     "sensor_scale_y", "leg_hardening", "torque_bias"};

TEST(DiagnosisStatistics, AnEffectInOneTrialIsReportedForThatTrial) {
  const int seeds = SeedCount(10);
  std::vector<Truth> truths;
  for (std::size_t n = 0; n < kRuleEffects.size(); n += static_cast<std::size_t>(EveryNth())) {
    for (int i = 0; i < seeds; ++i) {
      const Law law = kAllLaws[(n + static_cast<std::size_t>(i)) % (kAllLaws.size() - 1)];
      const EffectCase* e = CaseOf(law, kRuleEffects[n]);
      if (!e || e->At(4.0).empty()) continue;
      // One of five trials has about a fifth of the information: twice the size for the same sight.
      const EffectDirection& d = *e->At(4.0).front();
      Truth truth{.law = law,
                  .effects = {{kRuleEffects[n], d.Values(*e->effect, 8.0)}},
                  .size = 8.0,
                  .only_recording = "train-" + std::to_string(1 + i % 5) + ".csv",
                  .seed = NoiseSeed(Table::kRules, static_cast<int>(100 * n) + i)};
      std::vector<std::string> notes;
      MakeDataset(truth, &notes);
      if (notes.empty()) truths.push_back(truth);
    }
  }
  const std::vector<Outcome> outcomes = RunAll(truths);
  Report report("6-one-trial", "An effect in one trial only");
  report.Say(
      "8 delta80 of the effect in one of the five train trials. Rule: the reported set holds "
      "the effect in that trial in at least 80 %% of the cases, and the effect in every "
      "trial never stands alone.");
  int held = 0, everywhere = 0;
  std::vector<Outcome> missed;
  for (const Outcome& o : outcomes) {
    held += o.HoldsAll();
    everywhere += o.verdict == Verdict::kNamed && o.Holds(o.truth.effects.front().name);
    if (!o.HoldsAll()) missed.push_back(o);
  }
  const auto all = static_cast<long>(outcomes.size());
  report.Say("%ld cases: in that trial %.0f %%, in every trial and alone %.0f %%. The others:", all,
             PerCent(held, all), PerCent(everywhere, all));
  PrintCases(report, missed);
  EXPECT_TRUE(IsAtLeast(held, all, 0.80)) << held << " of " << all;
  EXPECT_TRUE(IsAtMost(everywhere, all, 0.05)) << everywhere << " of " << all;
}

TEST(DiagnosisStatistics, AnEffectOfTheWrongSignIsNotNamed) {
  const int seeds = SeedCount(5);
  std::vector<Truth> truths;
  int place = 0;
  for (Law law : kAllLaws) {
    for (const EffectCase& e : AllEffectCases()) {
      const EffectParameter& p = e.effect->info.parameters[0];
      const bool one_sided = p.lower >= p.null || p.upper <= p.null;
      if (e.law != law || !one_sided || e.At(4.0).empty()) continue;
      if (place++ % (EveryNth() * EveryNth()) != 0) continue;
      for (int i = 0; i < seeds; ++i) {
        truths.push_back({.law = law,
                          .effects = {{std::string(e.effect->info.name),
                                       e.At(4.0).front()->Values(*e.effect, 4.0)}},
                          .size = -4.0,
                          .mirrored = true,
                          .seed = NoiseSeed(Table::kRules, 5000 + i)});
      }
    }
  }
  const std::vector<Outcome> outcomes = RunAll(truths);
  Report report("6-wrong-sign", "An effect of the wrong sign");
  report.Say(
      "Effects that may act one way only, their traces mirrored about those without them (4 "
      "delta80 of the unphysical sign, to first order). Rule: such an effect is in no "
      "reported set.");
  report.Head({"effect", "cases", "itself named", "adequate", "unexplained", "another name alone"});
  struct Counts {
    int cases = 0, itself = 0, adequate = 0, unexplained = 0, other = 0;
  };
  std::map<std::string, Counts> counts;
  int itself = 0;
  for (const Outcome& o : outcomes) {
    Counts& c = counts[o.truth.effects.front().name];
    ++c.cases;
    c.itself += o.Holds(o.truth.effects.front().name);
    c.adequate += o.verdict == Verdict::kAdequate;
    c.unexplained += o.verdict == Verdict::kUnexplained;
    c.other += o.NamesWrongly();
    itself += o.Holds(o.truth.effects.front().name);
  }
  for (const auto& [name, c] : counts) {
    const auto share = [cases = c.cases](int part) { return Cell("%.0f", PerCent(part, cases)); };
    report.Row({name, Cell("%d", c.cases), share(c.itself), share(c.adequate), share(c.unexplained),
                share(c.other)});
  }
  EXPECT_TRUE(IsAtMost(itself, static_cast<long>(outcomes.size()), 0.02)) << itself;
}

}  // namespace
}  // namespace hoplab::testing
