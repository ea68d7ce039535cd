// The effect behind the data is not in the catalogue: what is said then.
// ctest -L statistics

#include <gtest/gtest.h>

#include <map>

#include "tests/fitting/diagnosis/study.h"

namespace hoplab::testing {
namespace {

struct LeftOutCounts {
  int cases = 0, unexplained = 0, adequate = 0, confounded = 0, exclusive = 0, confident = 0,
      doubted = 0;
  std::map<std::string, int> names;

  void Add(const Outcome& o) {
    ++cases;
    unexplained += o.verdict == Verdict::kUnexplained;
    adequate += o.verdict == Verdict::kAdequate;
    confounded += o.verdict == Verdict::kConfounded;
    exclusive += o.verdict == Verdict::kNamed;
    // The data could have refuted the name: the true effect is still seen beside it.
    const bool refuted = o.verdict == Verdict::kNamed && o.left_p.front() < 0.01;
    confident += refuted;
    doubted += refuted && o.in_doubt;
    if (o.Names()) {
      std::string name;
      for (const auto& group : o.groups) name += (name.empty() ? "" : " + ") + group.front();
      ++names[name];
    }
  }
  std::vector<std::string> Row(const std::string& name) const {
    const auto share = [&](int part) { return Cell("%.0f", PerCent(part, cases)); };
    std::string instead;
    for (const auto& [n, count] : names)
      instead += (instead.empty() ? "" : ", ") + n + " " + std::to_string(count);
    return {name,
            Cell("%d", cases),
            share(unexplained),
            share(adequate),
            share(confounded),
            share(exclusive),
            share(confident),
            share(doubted),
            instead};
  }
};

TEST(DiagnosisStatistics, AnEffectOutsideTheCatalogueIsNotGivenAConfidentWrongName) {
  const int seeds = SeedCount(20);
  const std::vector<Outcome> outcomes =
      RunAll(PlantEach(Table::kLeftOut, 4.0, seeds),
             [](const Truth& t) { return std::vector{t.effects.front().name}; });
  Report report("4-left-out", "The effect is not in the catalogue");
  report.Say(
      "Each effect at 4 delta80, %d seeds, with its own name left out. Shares in per cent. A "
      "`confident wrong name` stands alone although the data refute it: the true effect's "
      "score beside the accepted extension has p < 0.01. `In doubt` are those given with the words "
      "that something remains or may remain (p <= 0.05 beside it) and that the name may stand in "
      "for another cause.",
      seeds);
  report.Head({"planted", "cases", "unexplained", "adequate", "confounded", "one name",
               "confident wrong name", "of these in doubt", "names instead"});
  std::map<std::string, LeftOutCounts> counts;
  LeftOutCounts all;
  for (const Outcome& o : outcomes) {
    if (!o.refusal.empty()) continue;
    counts[o.truth.effects.front().name].Add(o);
    all.Add(o);
  }
  for (const auto& [name, c] : counts) report.Row(c.Row(name));
  all.names.clear();
  report.Row(all.Row("all"));
  EXPECT_TRUE(IsAtMost(all.confident, all.cases, 0.10)) << all.confident << " of " << all.cases;
}

}  // namespace
}  // namespace hoplab::testing
